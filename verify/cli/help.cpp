// SPDX-License-Identifier: MIT
// The examples of --help.

#include <map>
#include <memory>

#include "data/error.h"
#include "verify/cli/commands.h"

namespace limitcheck::cli {
namespace {

class WithExamples : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override {
    std::string out = app->get_description() + "\n";
    const std::vector<Example> examples = examples_of(app->get_parent() == nullptr ? "" : app->get_name());
    if (examples.empty()) return out;
    out += "\nExamples:\n";
    for (const Example& e : examples) out += fmt::format("  {}\n      {}\n", e.line, e.purpose);
    return out + "\n";
  }
};

}  // namespace

std::vector<Example> examples_of(std::string_view command) {
  static const std::map<std::string_view, std::vector<Example>> all{
      {"",
       {{"limitcheck check cage.obj", "what is wrong with a mesh"},
        {"limitcheck audit cage.obj", "all tessellators, on it"},
        {"limitcheck help audit", "the options of a command"}}},
      {"audit",
       {{"limitcheck audit ./libmine.so", "a tessellator of yours, on the meshes that are chosen for it"},
        {"limitcheck audit opensubdiv-bfr cube --depth 3", "one that is built in, on one mesh"},
        {"limitcheck audit --control cage.obj --tessellation fine.ply",
         "a file that any program has written"}}},
      {"hunt",
       {{"limitcheck hunt ./libmine.so --time 10m", "search for ten minutes"},
        {"limitcheck hunt row-stream --cases 20", "one that is built in, on twenty meshes"}}},
      {"merge",
       {{"limitcheck merge part1.json part2.json -o report.json", "one report of two shards"},
        {"limitcheck merge --verify report.json", "whether a report is whole and as it was written"}}},
      {"eval",
       {{"limitcheck eval icosahedron 0 1/3 1/3 --digits 40", "the middle of a face, to 40 digits"},
        {"limitcheck eval quad-cube 0 1/2 1/4", "Catmull-Clark's scheme"},
        {"limitcheck eval cage.obj --points points.csv --derivatives 2", "many points, with curvatures"}}},
      {"claims",
       {{"limitcheck claims", "all claims of the paper"},
        {"limitcheck claims C14", "one of them"},
        {"limitcheck claims --errata", "what is to be corrected in it"}}},
      {"generate",
       {{"limitcheck generate --list", "the names of meshes"},
        {"limitcheck generate wheel:7 -o wheel.obj", "a wheel of seven triangles"},
        {"limitcheck generate creased-cube:2 -o creased.obj", "quads with semi-sharp edges"}}},
      {"check",
       {{"limitcheck check cage.obj", "as text"}, {"limitcheck check cage.obj --json", "for programs"}}},
      {"repair",
       {{"limitcheck repair scan.obj -o cage.obj", "mend it"},
        {"limitcheck repair scan.obj --weld 1e-6 -o cage.obj", "and close seams"}}},
      {"prove",
       {{"limitcheck prove --set sample", "every tenth topology, in ten seconds"},
        {"limitcheck prove --scheme catmull-clark --valences 3:5 --depth 2", "chosen quads"}}},
      {"mutants",
       {{"limitcheck mutants", "which check finds which fault"},
        {"limitcheck mutants --json mutants.json", "the same for programs"}}},
      {"tessellate",
       {{"limitcheck tessellate bumpy:800 --depth 3 -o fine.ply", "every face alike"},
        {"limitcheck tessellate bumpy:800 --camera 0,0,4 -o view.glb", "as deep as a view needs"},
        {"limitcheck tessellate quad-cube --strategy random --colour depth -o cube.ply",
         "depths as colours"}}},
  };
  const auto found = all.find(command);
  return found == all.end() ? std::vector<Example>{} : found->second;
}

void show_examples(CLI::App& app) {
  app.formatter(std::make_shared<WithExamples>());
}

void group(CLI::App& command, const char* title, std::initializer_list<const char*> options) {
  for (const char* option : options) command.get_option(option)->group(title);
}

void refuse(const CLI::App& command, std::initializer_list<const char*> options, const std::string& why) {
  for (const char* option : options)
    if (command.count(option) > 0) throw data::ArgumentError(fmt::format("{} {}", option, why));
}

}  // namespace limitcheck::cli
