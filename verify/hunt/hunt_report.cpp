// SPDX-License-Identifier: MIT
#include "verify/hunt/hunt_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "data/error.h"
#include "data/untrusted_json.h"
#include "verify/report/forms.h"

namespace limitcheck::verify {

namespace {

using Json = nlohmann::ordered_json;

// Each field of a finding with its key, in the order of the report.
template <class Where, class Visit>
void each_field_of_place(Where& where, const Visit& visit) {
  visit("kind", where.kind), visit("valence", where.valence), visit("rank", where.rank);
  visit("beside", where.beside), visit("depth_difference", where.difference);
}
template <class Finding, class Visit>
void each_field(Finding& f, const Visit& visit) {
  visit("signature", f.signature), visit("check", f.check), visit("status", f.status);
  visit("scheme", f.scheme), visit("severity", f.severity()), visit("where", f.where);
  visit("cases", f.cases), visit("first", f.first), visit("found_on", f.found_on);
  visit("faces_before", f.faces_before), visit("depth_before", f.depth_before);
  visit("worst", f.worst), visit("bound", f.bound), visit("unit", f.unit), visit("message", f.message);
  visit("faces", f.faces), visit("depth", f.depth), visit("witness", f.witness), visit("command", f.command);
}

struct Write {
  Json& json;
  template <class Value>
  void operator()(const char* key, const Value& value) const {
    json[key] = value;
  }
  void operator()(const char* key, const std::optional<double>& x) const {
    json[key] = x && std::isfinite(*x) ? Json(*x) : Json(nullptr);
  }
  void operator()(const char* key, const LikelyCause& where) const {
    each_field_of_place(where, Write{json[key]});
  }
};
struct Read {
  const nlohmann::json& json;
  template <class Value>
  void operator()(const char* key, Value& value) const {
    data::read_value(json.at(key), value);
  }
  void operator()(const char* key, std::optional<double>& x) const {
    if (json.at(key).is_number()) x = json.at(key).get<double>();
  }
  void operator()(const char* key, LikelyCause& where) const {
    each_field_of_place(where, Read{json.at(key)});
  }
  void operator()(const char* /*severity*/, const std::string&& /*follows from the rest*/) const {}
};

Json to_json(const HuntFinding& f) {
  Json json;
  each_field(f, Write{json});
  return json;
}
HuntFinding finding_of(const nlohmann::json& json) {
  HuntFinding f;
  each_field(f, Read{json});
  return f;
}

// Of a finding in several shards the first case counts.
void take(std::map<std::string, HuntFinding>& all, const HuntFinding& more) {
  const auto [at, is_new] = all.try_emplace(more.signature, more);
  if (is_new) return;
  const std::int64_t cases = at->second.cases + more.cases;
  if (more.first < at->second.first) at->second = more;
  at->second.cases = cases;
}

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

std::string HuntFinding::severity() const {
  const double ratio = status != "finding" ? HUGE_VAL : worst && bound && *bound > 0 ? *worst / *bound : 1;
  return ratio >= 1000 ? "high" : ratio >= 10 ? "medium" : "low";
}

bool HuntFinding::covers(const HuntFinding& other) const {
  return scheme == other.scheme && check == other.check && status == other.status &&
         where.covers(other.where);
}

std::vector<const HuntFinding*> HuntReport::by_severity() const {
  const auto rank = [](const HuntFinding* f) {
    const std::string severity = f->severity();
    return severity == "high" ? 0 : severity == "medium" ? 1 : 2;
  };
  std::vector<const HuntFinding*> all;
  for (const auto& [signature, f] : findings) all.push_back(&f);
  std::stable_sort(all.begin(), all.end(),
                   [&](const HuntFinding* a, const HuntFinding* b) { return rank(a) < rank(b); });
  return all;
}

std::vector<const HuntFinding*> HuntReport::uncovered() const {
  std::vector<const HuntFinding*> all = by_severity();
  std::erase_if(all, [&](const HuntFinding* f) {
    return std::any_of(findings.begin(), findings.end(), [&](const auto& g) { return g.second.covers(*f); });
  });
  return all;
}

std::vector<HuntFinding*> HuntReport::to_shrink() {
  std::map<std::tuple<std::string, std::string, std::string, std::string>, HuntFinding*> least;
  const auto order = [](const HuntFinding& f) { return std::tuple(f.where.level(), f.first, f.signature); };
  for (auto& [signature, f] : findings) {
    HuntFinding*& at = least[{f.scheme, f.check, f.status, f.where.kind}];
    if (at == nullptr || order(f) < order(*at)) at = &f;
  }
  std::vector<HuntFinding*> chosen;
  for (const HuntFinding* f : uncovered())
    for (const auto& [key, g] : least)
      if (g == f) chosen.push_back(g);
  return chosen;
}

std::vector<const HuntFinding*> new_findings(const HuntReport& report, const HuntReport* earlier) {
  std::vector<const HuntFinding*> all = report.uncovered();
  if (earlier != nullptr)
    std::erase_if(all, [&](const HuntFinding* f) {
      return std::any_of(earlier->findings.begin(), earlier->findings.end(),
                         [&](const auto& g) { return g.first == f->signature || g.second.covers(*f); });
    });
  return all;
}

nlohmann::json HuntReport::add(const HuntReport& more) {
  nlohmann::json added{{"cases", more.cases}, {"judged", more.judged}, {"seconds", more.seconds}};
  added["kinds"] = added["findings"] = nlohmann::json::array();
  cases += more.cases, judged += more.judged, seconds += more.seconds;
  for (const std::uint64_t kind : more.kinds)
    if (kinds.insert(kind).second) added["kinds"].push_back(kind);
  for (const auto& [signature, f] : more.findings) {
    const Json told = findings.contains(signature) ? Json{{"signature", signature}} : to_json(f);
    added["findings"].push_back(nlohmann::json(told));
    take(findings, f);
  }
  return added;
}

nlohmann::json HuntReport::small_meshes() const {
  nlohmann::json small = nlohmann::json::array();
  for (const auto& [signature, f] : findings)
    if (f.faces > 0) small.push_back(nlohmann::json(to_json(f)));
  return {{"small", std::move(small)}};
}

void HuntReport::add_again(const nlohmann::json& added) try {
  if (added.contains("small")) {
    for (const auto& f : added.at("small")) findings[f.at("signature").get<std::string>()] = finding_of(f);
    seconds += added.value("seconds", 0.0);
    return;
  }
  cases += data::value_of<std::uint64_t>(added.at("cases")),
      judged += data::value_of<std::int64_t>(added.at("judged"));
  seconds += added.at("seconds").get<double>();
  for (const std::uint64_t kind : added.at("kinds")) kinds.insert(kind);
  for (const auto& f : added.at("findings")) {
    const auto known = findings.find(f.at("signature").get<std::string>());
    if (f.contains("check"))
      take(findings, finding_of(f));
    else if (known != findings.end())
      ++known->second.cases;
    else
      throw data::ArgumentError("a finding of the journal is told nowhere");
  }
} catch (const Json::exception& error) {
  throw data::ArgumentError(fmt::format("this is no journal of a hunt: {}", error.what()));
}

std::string to_json(const HuntReport& r) {
  Json findings = Json::array();
  for (const HuntFinding* f : r.by_severity()) findings.push_back(to_json(*f));
  const Json json{{"program", "limitcheck hunt"},
                  {"version", r.version},
                  {"subject", r.subject},
                  {"seed", r.seed},
                  {"asked", r.asked},
                  {"schemes", r.schemes},
                  {"varied", r.varied},
                  {"shard", {{"index", r.shard.index}, {"count", r.shard.count}}},
                  {"cases", r.cases},
                  {"next", r.next},
                  {"judged", r.judged},
                  {"edge_kinds", r.shard.count > 1 ? Json(r.kinds) : Json(r.kinds.size())},
                  {"findings", findings},
                  {"seconds", r.seconds},
                  {"incomplete", r.incomplete},
                  {"attested", r.attested}};
  return sealed(json, 1);
}

HuntReport read_hunt_report(const std::string& text) try {
  const nlohmann::json json = unsealed(text, /*digest_may_lack=*/true);
  if (json.at("program") != "limitcheck hunt") throw data::ArgumentError("this is no report of a hunt");
  HuntReport r;
  json.at("version").get_to(r.version), json.at("subject").get_to(r.subject);
  data::read_value(json.at("seed"), r.seed), data::read_value(json.at("asked"), r.asked),
      json.at("schemes").get_to(r.schemes);
  json.at("varied").get_to(r.varied);
  data::read_value(json.at("shard").at("index"), r.shard.index);
  data::read_value(json.at("shard").at("count"), r.shard.count);
  data::read_value(json.at("cases"), r.cases), data::read_value(json.at("next"), r.next),
      data::read_value(json.at("judged"), r.judged);
  if (json.at("edge_kinds").is_array()) json.at("edge_kinds").get_to(r.kinds);
  if (!json.at("findings").is_array()) throw data::ArgumentError("its findings are no list");
  for (const auto& f : json.at("findings")) take(r.findings, finding_of(f));
  json.at("seconds").get_to(r.seconds), json.at("incomplete").get_to(r.incomplete);
  r.attested = json.value("attested", nlohmann::json());
  return r;
} catch (const Json::exception& error) {
  throw data::ArgumentError(fmt::format("this is no report of a hunt: {}", error.what()));
}

HuntReport combined(const std::vector<HuntReport>& parts) {
  HuntReport whole = parts.at(0);
  whole.shard = {}, whole.cases = 0, whole.judged = 0, whole.seconds = 0;
  whole.next = 0, whole.findings.clear();
  for (const HuntReport& p : parts) {
    whole.cases += p.cases, whole.judged += p.judged, whole.seconds += p.seconds;
    whole.next = std::max(whole.next, p.next);
    whole.kinds.insert(p.kinds.begin(), p.kinds.end());
    if (whole.incomplete.empty()) whole.incomplete = p.incomplete;
    for (const auto& [signature, f] : p.findings) take(whole.findings, f);
  }
  const std::vector<HuntFinding*> small = whole.to_shrink();
  for (auto& [signature, f] : whole.findings)  // as if one process had found them all
    if (std::find(small.begin(), small.end(), &f) == small.end())
      f.faces = 0, f.depth = 0, f.witness.clear(), f.command.clear();
  return whole;
}

HuntReport merged(const std::vector<HuntReport>& parts) {
  std::vector<Shard> shards;
  for (const HuntReport& p : parts) {
    const HuntReport& first = parts.front();
    const auto hunt = [](const HuntReport& r) {
      return std::tie(r.version, r.subject, r.seed, r.asked, r.schemes, r.varied, r.shard.count);
    };
    const auto refuse = [&](const std::string& why) {
      throw data::ArgumentError(fmt::format("shard {} {}", p.shard.text(), why));
    };
    if (hunt(p) != hunt(first)) refuse("is of another hunt than shard " + first.shard.text());
    if (!p.incomplete.empty()) refuse("is incomplete: " + p.incomplete);
    shards.push_back(p.shard);
  }
  require_all(shards);
  return combined(parts);
}

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
        " ({} more of the same checks, where there is all that is said here and more, are in --json)",
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
