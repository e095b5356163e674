// SPDX-License-Identifier: MIT
// The report for other programs: JUnit XML, and the root causes as SARIF 2.1.0 and as a page of Markdown.
#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "verify/report/forms.h"
#include "verify/row/commands.h"
#include "verify/row/rows.h"
#include "verify/row/visible_text.h"

namespace limitcheck::verify {
namespace {

using Ordered = nlohmann::ordered_json;

// Tools split class names at dots, and take the last part for the class.
std::string without_dots(std::string text) {
  std::ranges::replace(text, '.', '_');
  return text;
}

std::string describe(const Result& r) {
  std::string text = fmt::format("{} of {}", r.bad, r.of);
  if (r.worst) text += fmt::format(", worst {:.3e} {}", *r.worst, r.unit);
  if (r.bound) text += fmt::format(", bound {:.3e}", *r.bound);
  if (!r.message.empty()) text += "; " + r.message;
  return text;
}

std::string outcome(const Result& r) {
  const std::string text = xml_text(describe(r));
  switch (r.status) {
    case Status::kHeld:
      return "";
    case Status::kQualityWarning:
    case Status::kUnexpectedPass:
      return fmt::format("<system-out>{}: {}</system-out>", word(r.status), text);
    case Status::kFinding:
      return fmt::format(
          "<failure message=\"{}\">{}</failure>", text,
          xml_text(difference_command(r).empty() ? audit_command(r, "standard") : difference_command(r)));
    case Status::kNotSupported:
    case Status::kNotRun:
    case Status::kWaived:
      return fmt::format("<skipped message=\"{}: {}\"/>", word(r.status), text);
    default:
      return fmt::format("<error message=\"{}: {}\"/>", word(r.status), text);
  }
}

// A subject's label as a relative reference of RFC 3986, of which a colon in front would be a scheme.
std::string uri(const std::string& text) {
  std::string out;
  for (const char c : visible_text(text)) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-._~/").find(c) != std::string_view::npos;
    out += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

// Text of somebody else's in Markdown: nothing in it is a mark, a link or HTML.
std::string markdown_text(const std::string& text) {
  std::string out;
  for (const char c : visible_text(text))
    if (c == '\n' || c == '\t')
      out += ' ';
    else if (std::string_view("\\`*_{}[]<>()#+!|~&").find(c) != std::string_view::npos)
      out += std::string("\\") + c;
    else
      out += c;
  return out;
}

}  // namespace

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : visible_text(text))
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\n' || c == '\t')
      out += ' ';
    else
      out += c;
  return out;
}

std::string to_junit(const Report& report) {
  std::string suites;
  if (!report.incomplete.empty())
    suites = fmt::format(
        " <testsuite name=\"audit\" tests=\"1\" failures=\"0\" errors=\"1\" skipped=\"0\" time=\"0\">\n"
        "  <testcase classname=\"audit\" name=\"complete\" time=\"0\"><error message=\"{}\"/></testcase>\n"
        " </testsuite>\n",
        xml_text(report.incomplete));
  for (const std::string& subject : report.subjects) {
    int tests = 0, failures = 0, errors = 0, skipped = 0;
    std::string cases;
    double seconds = 0;
    for (const Result& r : report.results) {
      if (r.subject != subject) continue;
      const std::string body = outcome(r);
      ++tests;
      failures += body.starts_with("<failure");
      errors += body.starts_with("<error");
      skipped += body.starts_with("<skipped");
      cases += fmt::format("  <testcase classname=\"{}.{}\" name=\"{}\" time=\"{:.3f}\">{}</testcase>\n",
                           xml_text(without_dots(subject)), xml_text(without_dots(case_name(report, r))),
                           xml_text(r.check), r.seconds, body);
      seconds += r.seconds;
    }
    suites += fmt::format(
        " <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" "
        "time=\"{:.3f}\">\n{} </testsuite>\n",
        xml_text(subject), tests, failures, errors, skipped, seconds, cases);
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"limitcheck audit\" "
      "time=\"{:.3f}\">\n{}</testsuites>\n",
      report.seconds, suites);
}

std::string to_sarif(const Report& report, const std::vector<Cause>& causes, const std::string& level) {
  Ordered rules = Ordered::array(), results = Ordered::array();
  std::vector<std::string> known;
  for (const Cause& c : causes) {
    const Result& example = report.results[c.example];
    const std::string rule = visible_text(example.check);
    const auto at = std::ranges::find(known, rule);
    const auto index = at - known.begin();
    if (at == known.end()) {
      known.push_back(rule);
      const RowKind* kind = row_kind(rule);
      const std::string meaning(kind == nullptr ? rule : kind->meaning);
      rules.push_back(
          {{"id", rule},
           {"shortDescription", {{"text", meaning}}},
           {"help", {{"text", kind == nullptr ? meaning : fmt::format("Bound: {}", kind->bound)}}}});
    }
    const std::string_view severity = c.severity();
    Ordered locations = Ordered::array();
    for (const std::string& subject : c.subjects)
      locations.push_back(
          {{"physicalLocation", {{"artifactLocation", {{"uri", uri(subject)}}}}},
           {"logicalLocations", Ordered::array({{{"name", visible_text(case_name(report, example))}}})}});
    results.push_back(
        {{"ruleId", rule},
         {"ruleIndex", index},
         {"level", severity == "high"     ? "error"
                   : severity == "medium" ? "warning"
                                          : "note"},
         {"message",
          {{"text", visible_text(fmt::format("{}: {}, in {} of {} cases", c.who, c.title, c.cases, c.of))}}},
         {"locations", std::move(locations)},
         {"partialFingerprints",
          {{"limitcheck/1", visible_text(fmt::format("{} / {} / {}", c.who, word(c.kind), rule))}}},
         {"properties", {{"command", visible_text(command_for(report, c, level))}}}});
  }
  const Ordered driver{{"name", "limitcheck"}, {"version", report.version}, {"rules", std::move(rules)}};
  const Ordered run{{"tool", {{"driver", driver}}},
                    {"invocations", Ordered::array({{{"executionSuccessful", report.incomplete.empty()}}})},
                    {"results", std::move(results)}};
  return Ordered{{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                 {"version", "2.1.0"},
                 {"runs", Ordered::array({run})}}
             .dump(1, ' ', false, Ordered::error_handler_t::replace) +
         "\n";
}

std::string to_markdown(const Report& report, const std::vector<Cause>& causes, const std::string& level) {
  std::string out = "# " + markdown_text(header(report)) + "\n\n| subject |", line = "\n|---|";
  std::vector<const CheckGroup*> groups;
  for (const CheckGroup& g : check_groups(report))
    if (std::ranges::any_of(report.subjects,
                            [&](const std::string& s) { return verdict_of(report, s, g).looked_at > 0; }))
      groups.push_back(&g);
  for (const CheckGroup* g : groups) {
    out += fmt::format(" {} |", g->title);
    line += "---|";
  }
  out += line + "\n";
  for (const std::string& subject : report.subjects) {
    out += fmt::format("| {} |", markdown_text(subject));
    for (const CheckGroup* g : groups) out += fmt::format(" {} |", verdict_of(report, subject, *g).text());
    out += "\n";
  }
  out += "\n";
  for (std::size_t k = 0; k < causes.size(); ++k) {
    const Cause& c = causes[k];
    out += fmt::format("{}. **{}** {}: {}, in {} of {} cases\n", k + 1, c.severity(),
                       markdown_text(c.label()), markdown_text(c.title), c.cases, c.of);
    std::string command = visible_text(command_for(report, c, level));
    std::ranges::replace(command, '\n', ' ');
    if (!command.empty()) out += fmt::format("\n        {}\n\n", command);
  }
  return out + "\n" + markdown_text(changes_line(report)) + "\n\n" + markdown_text(summary(report)) + "\n";
}

}  // namespace limitcheck::verify
