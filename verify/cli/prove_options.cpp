// SPDX-License-Identifier: MIT
// The options of limitcheck prove, known to limitcheck and to limitcheck-prove, which does it.

#include "verify/cli/commands.h"
#include "verify/cli/units.h"
#include "verify/proof/proof_set.h"

namespace limitcheck::cli {

void add_prove(CLI::App& app, const std::function<void(const ProveRequest&)>& prove) {
  CLI::App* command = app.add_subcommand(
      "prove",
      "Prove that the kernels compute the exact limit surface, whatever the geometry, topology by topology");
  auto request = std::make_shared<ProveRequest>();
  request->depth = verify::ProofRequest().depth;
  add_choice(*command, "--scheme", request->scheme, {"loop", "catmull-clark"}, "The subdivision scheme");
  command->add_option("--valences", request->valences,
                      "Interior valences: of the triples 3:12 or a list 3,4,6; 3:8 of a quad's four corners");
  add_number(*command, "--depth", request->depth, 0, 8, "Deepest subdivision");
  add_choice(*command, "--kernel", request->kernel, {"sliding-window", "row-stream", "all"}, "The kernel");
  add_choice(*command, "--set", request->set, {"sample", "standard", "full"},
             "How much: standard takes three minutes on two cores, full some twenty; sample, every tenth "
             "topology of the standard set, takes ten seconds");
  command->add_flag("--each", request->each, "A line for every topology, not for every group of them");
  add_json_option(*command, request->shard);
  add_shard_options(*command, request->shard, "topologies");
  command->footer(
      "Both sets hold every triple of valences, valences 20, 50 and 100, boundaries, the face alone and the\n"
      "pairs of bumpy spheres, on every kernel. Maps (m) and float bounds (b) to depth, standard | full:\n"
      "  triples    every triple, each corner facing the diagonal   m 4, every triple once 6, b 4 | m 6, b "
      "4\n"
      "             every triple once                               b - | 6\n"
      "  high       valences 20, 50, 100                            m 4, b 4 | m 6, b 6\n"
      "  boundary   around pairs of four kinds                      m 3, b 3 | m 6, b 4; the regular pair b "
      "6\n"
      "  alone      the face without neighbours                     m 4, b 4 | m 6, b 6\n"
      "  spheres    all pairs of bumpy:200 | 200 800 2000 4000      m 3, b 3 | m 6, b 4\n"
      "Maps again to 45 digits, depth 1-2 | 3, and exactly for valences 3, 4, 6, depth 2 | 5.\n"
      "Of Catmull-Clark's scheme, maps in residues (r), rationals (e) and to 45 digits (d):\n"
      "  quadruples every four valences in every order              r 2, e 1, d 0, b 2 | r 4, e 3, d 2, b 4\n"
      "  deep       the regular quad and others                     r 6, e 3, d 2, b 5 | r 7, e 5, d 4, b 6\n"
      "  high       valences 20 and 50 at every corner              r 2, e 1, d 0, b 2 | r 5, e 2, d 1, b 4\n"
      "  boundary   boundary edges and vertices                     r 3, e 1, d 0, b 2 | r 5, e 3, d 2, b 4\n"
      "  cuts       creases and corners                             e 2, d 0, b 2      | e 3, d 2, b 4\n"
      "  darts      ends of creases                                 d 1, b 2           | d 3, b 4\n"
      "  semi-sharp edges and vertices, sliding window              e 1, b 2           | e 3, b 4\n"
      "Ctrl-C ends with the table of the proofs so far: exit code 130, or 1 if one of them failed.");
  command->add_option("--parts", request->parts, "Report these parts of --shard")->group("");
  command->callback([request, prove] { prove(*request); });
}

}  // namespace limitcheck::cli
