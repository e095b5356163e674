// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>

#include "verify/hunt/hunt_report.h"
#include "verify/report/junit.h"

namespace limitcheck::verify {
namespace {

std::string size_of(const HuntFinding& f) {
  if (!f.worst) return f.message;
  return fmt::format("{:.2g}{}{}{}", *f.worst, f.unit.empty() ? "" : " ", f.unit,
                     f.bound ? fmt::format(" (bound {:.2g})", *f.bound) : "");
}

std::string mesh_of(const HuntFinding& f) {
  const std::string before =
      fmt::format("{} faces at depth {} of case {}", f.faces_before, f.depth_before, f.first);
  if (f.faces == 0) return before;
  return fmt::format("{} face{} at depth {}, shrunk from {}", f.faces, f.faces == 1 ? "" : "s", f.depth,
                     before);
}

const std::string& command_of(const HuntFinding& f) {
  return f.command.empty() ? f.found_on : f.command;
}

}  // namespace

std::string to_text(const HuntReport& r, const HuntReport* earlier) {
  std::string schemes;
  for (const std::string& s : r.schemes) schemes += (schemes.empty() ? "" : ", ") + s;
  std::string text =
      fmt::format("hunt of {}: {} cases (seed {}; {}{}), {} kinds of edges", r.subject, r.cases, r.seed,
                  schemes, r.shard.count > 1 ? "; shard " + r.shard.text() : "", r.kinds.size());
  if (r.seconds > 0)
    text += fmt::format(", {:.1f} cases per second and process", static_cast<double>(r.cases) / r.seconds);
  text += "\n";
  const std::vector<const HuntFinding*> fresh = new_findings(r, earlier);
  for (const HuntFinding* f : fresh)
    text += fmt::format("\n{}  {}\n  {}; in {} case{}\n  {}\n  {}\n", f->severity(), f->signature,
                        size_of(*f), f->cases, f->cases == 1 ? "" : "s", mesh_of(*f), command_of(*f));
  const std::size_t listed = earlier == nullptr ? fresh.size() : r.uncovered().size();
  text += fmt::format("\n{} finding{}", fresh.size(), fresh.size() == 1 ? "" : "s");
  if (earlier != nullptr)
    text += fmt::format(" that the baseline has not, {} that it has", listed - fresh.size());
  if (r.findings.size() > listed)
    text += fmt::format(
        " ({} more of the same checks, where there is all that is said here and more, are in "
        "--json)",
        r.findings.size() - listed);
  text += "\n";
  if (!r.incomplete.empty()) text += fmt::format("INCOMPLETE: {}\n", r.incomplete);
  return text;
}

std::string to_junit(const HuntReport& r, const HuntReport* earlier) {
  std::string cases;
  const std::vector<const HuntFinding*> fresh = new_findings(r, earlier);
  for (const HuntFinding* at : fresh) {
    const HuntFinding& f = *at;
    cases += fmt::format(
        "<testcase classname=\"hunt {}\" name=\"{}\"><failure message=\"{}\">{}</failure></testcase>\n",
        xml_text(r.subject), xml_text(f.signature), xml_text(size_of(f)), xml_text(command_of(f)));
  }
  if (fresh.empty())
    cases = fmt::format("<testcase classname=\"hunt {}\" name=\"{} cases\" time=\"{:.3f}\"/>\n",
                        xml_text(r.subject), r.cases, r.seconds);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n<testsuite name=\"hunt\" tests=\"{}\" "
      "failures=\"{}\" time=\"{:.3f}\">\n{}</testsuite>\n</testsuites>\n",
      std::max<std::size_t>(1, fresh.size()), fresh.size(), r.seconds, cases);
}

}  // namespace limitcheck::verify
