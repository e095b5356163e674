// SPDX-License-Identifier: MIT
#include "verify/report/judged.h"

#include <fmt/core.h>

#include <algorithm>

namespace limitcheck::verify {
namespace {

bool looked_at(const Result& r) {
  return r.status != Status::kNotSupported && r.status != Status::kNotRun;
}

}  // namespace

std::string NeverJudged::text() const {
  return fmt::format("{} of {} {} never judged{}{}", check, subject, check.ends_with('s') ? "were" : "was",
                     reason.empty() ? "" : ": ", reason);
}

std::vector<NeverJudged> never_judged(const Report& report, const std::vector<std::string>& checks) {
  std::vector<NeverJudged> missing;
  for (const std::string& subject : report.subjects)
    for (const std::string& check : checks) {
      NeverJudged none{subject, check, ""};
      bool judged = false;
      for (const Result& r : report.results) {
        if (r.subject != subject || r.check != check) continue;
        judged = judged || looked_at(r);
        if (none.reason.empty()) none.reason = r.message;
      }
      if (!judged) missing.push_back(std::move(none));
    }
  return missing;
}

std::vector<NeverJudged> never_judged(const Report& report) {
  std::vector<NeverJudged> missing = never_judged(report, {"positions", "normals", "rejected-inputs"});
  std::erase_if(missing, [&](const NeverJudged& none) {
    if (none.check == "rejected-inputs") return !none.reason.starts_with("not asked");
    const auto any = [&](const auto& of) {
      return std::any_of(report.results.begin(), report.results.end(),
                         [&](const Result& r) { return r.subject == none.subject && of(r); });
    };
    // What it tessellates nothing of, because it does not do the scheme, the table says.
    return !any([&](const Result& r) { return r.check == none.check; }) ||
           !any([&](const Result& r) { return r.check == "tessellates" && looked_at(r); }) ||
           (none.check == "positions" &&
            any([](const Result& r) { return r.check == "refined-positions" && looked_at(r); }));
  });
  return missing;
}

}  // namespace limitcheck::verify
