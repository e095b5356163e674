// SPDX-License-Identifier: MIT
#include "verify/report/exhaustive.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "data/generators/every_neighbourhood.h"

namespace limitcheck::verify {
namespace {

constexpr int kDepths = 3;
constexpr std::size_t kExamples = 5;

// "neighbourhoods:MOST:KINDS:K"
struct Name {
  bool triangles = true;
  int most = 0;
  std::int32_t kinds = 0;
  std::size_t number = 0;  // K - 1
  const std::vector<data::Stars>& meshes() const { return data::every_neighbourhood(triangles, most, kinds); }
};
bool parse(std::string_view text, Name& name) {
  name.triangles = !text.starts_with("quad-");
  if (!name.triangles) text.remove_prefix(5);
  constexpr std::string_view kWord = "neighbourhoods";
  if (!text.starts_with(kWord)) return false;
  text.remove_prefix(kWord.size());
  const auto read = [&](auto& to) {
    if (!text.starts_with(':')) return false;
    const auto [stop, error] = std::from_chars(text.data() + 1, text.data() + text.size(), to);
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    return error == std::errc();
  };
  return read(name.most) && read(name.kinds) && read(name.number) && name.number-- > 0;
}

struct Seen {
  std::map<std::size_t, std::set<int>> judged;  // depths of each mesh
  std::set<std::pair<std::size_t, int>> cases, wrong;
  std::map<std::string, std::pair<std::size_t, std::string>>
      examples;  // of each check the shortest, by its length
};

// The neighbourhood that a finding is at, as it is typed.
std::string example(const Name& name, const Result& r) {
  const std::string place = fmt::format(" (depth {}, {})", r.depth, r.check);
  if (!r.witness || r.witness->face < 0) return r.mesh + place;
  data::Stars stars = name.meshes().at(name.number);
  stars.stars = {data::star_of_face(stars, data::star_mesh(stars, name.triangles),
                                    static_cast<std::size_t>(r.witness->face))};
  return fmt::format("{}star:{}{}", name.triangles ? "" : "quad-", stars.text(), place);
}

}  // namespace

std::vector<Exhaustive> exhaustive_of(const std::vector<Result>& results) {
  std::map<std::tuple<std::string, data::Scheme, int, std::int32_t>, Seen> all;
  for (const Result& r : results) {
    Name name;
    if (!parse(r.mesh, name)) continue;
    Seen& seen = all[{r.subject, r.scheme, name.most, name.kinds}];
    const std::pair at{name.number, r.depth};
    seen.cases.insert(at);
    if ((r.check == "positions" || r.check == "refined-positions") && r.of > 0 &&
        r.status != Status::kNotRun && r.status != Status::kNotSupported)
      seen.judged[name.number].insert(r.depth);
    if (!is_bad(r)) continue;
    seen.wrong.insert(at);
    std::string text = example(name, r);
    const std::pair found{text.size(), std::move(text)};
    auto& shortest = seen.examples.try_emplace(r.check, found).first->second;
    shortest = std::min(shortest, found);
  }
  std::vector<Exhaustive> list;
  for (const auto& [key, seen] : all) {
    const auto& [subject, scheme, most, kinds] = key;
    Exhaustive& e = list.emplace_back();
    e.subject = subject, e.scheme = scheme, e.most = most;
    const auto& meshes = data::every_neighbourhood(scheme == data::Scheme::kLoop, most, kinds);
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      const auto count = static_cast<std::int64_t>(meshes[k].stars.size());
      e.neighbourhoods += count;
      if (const auto found = seen.judged.find(k);
          found != seen.judged.end() && found->second.size() == kDepths)
        e.looked += count;
    }
    e.cases = static_cast<std::int64_t>(seen.cases.size());
    e.wrong = static_cast<std::int64_t>(seen.wrong.size());
    for (const auto& [check, shortest] : seen.examples)
      if (e.examples.size() < kExamples) e.examples.push_back(shortest.second);
  }
  return list;
}

std::string exhaustive_lines(const Report& report) {
  std::string out;
  if (report.coverage.empty()) return out;  // a part of a report
  for (const Exhaustive& e : exhaustive_of(report.results)) {
    const std::string who = fmt::format("{}{}", data::name_of(e.scheme),
                                        report.subjects.size() > 1 ? " (" + e.subject + ")" : "");
    if (e.all_right()) {
      out += fmt::format("{}: right on every neighbourhood up to valence {}: {}, at depths 0, 1 and 2\n", who,
                         e.most, e.neighbourhoods);
      continue;
    }
    out += fmt::format("{}: {} of {} neighbourhoods up to valence {} were judged at depths 0, 1 and 2", who,
                       e.looked, e.neighbourhoods, e.most);
    if (e.wrong > 0)
      out += fmt::format("; wrong in {} of {} meshes and depths: {}", e.wrong, e.cases,
                         fmt::join(e.examples, ", "));
    out += "\n";
  }
  return out;
}

}  // namespace limitcheck::verify
