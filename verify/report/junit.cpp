// SPDX-License-Identifier: MIT
#include "verify/report/forms.h"

#include <fmt/core.h>

#include <algorithm>

#include "verify/row/commands.h"
#include "verify/row/visible_text.h"

namespace limitcheck::verify {
namespace {

// Tools split class names at dots, and take the last part for the class.
std::string without_dots(std::string text) {
  std::replace(text.begin(), text.end(), '.', '_');
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
        "time=\"{:.3f}\">\n{} "
        "</testsuite>\n",
        xml_text(subject), tests, failures, errors, skipped, seconds, cases);
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"limitcheck audit\" "
      "time=\"{:.3f}\">\n{}</testsuites>\n",
      report.seconds, suites);
}

}  // namespace limitcheck::verify
