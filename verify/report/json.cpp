// SPDX-License-Identifier: MIT
#include "verify/report/json.h"

#include <fmt/core.h>

#include <algorithm>

#include "data/error.h"
#include "data/io/atomic_file.h"
#include "data/untrusted_json.h"
#include "verify/report/coverage.h"
#include "verify/report/forms.h"
#include "verify/row/commands.h"
#include "verify/row/fields.h"
#include "verify/row/rows.h"

namespace limitcheck::verify {

/// Calls visit(name, member) for each, in the order of the report. A structured binding names all members: with a new one
/// this does not compile until it is visited, too. Fields without a name are of no use to who reads a report: only the
/// parts have them of which a report is made.
static void visit_fields(Is<IllConditioned> auto& row, auto&& visit) {
  auto& [count, bound, worst] = row;
  visit_each(visit, {"count", "bound", "worst"}, count, bound, worst);
}
static void visit_fields(Is<PlaceCount> auto& row, auto&& visit) {
  auto& [kind, faces, bad, of] = row;
  visit_each(visit, {"where", "faces", "count", "of"}, kind, faces, bad, of);
}
static void visit_fields(Is<Recognised> auto& row, auto&& visit) {
  auto& [what, scheme, steps, limit, tags] = row;
  visit_each(visit, {"what", "scheme", "steps", "limit", "tags"}, what, scheme, steps, limit, tags);
}
static void visit_fields(Is<Witness> auto& row, auto&& visit) {
  auto& [face, l1, l2, vertex, triangle, expected, got, digits, corner, channel, rule] = row;
  visit_each(visit,
             {"face", "corner", "l1", "l2", "vertex", "triangle", "expected", "got", "expected_digits",
              "channel", "channel_rule"},
             face, corner, l1, l2, vertex, triangle, expected, got, digits, channel, rule);
}
static void visit_fields(Is<Report::Mesh> auto& row, auto&& visit) {
  auto& [name, vertices, faces, scheme, triangulated, diagonal] = row;
  visit_each(visit, {"name", "vertices", "faces", "diagonal", "scheme", "triangulated"}, name, vertices,
             faces, diagonal, scheme, triangulated);
}
static void visit_fields(Is<Receipt> auto& row, auto&& visit) {
  auto& [subject, processes, at_once, bytes, shared, crashes, time, memory, protocol] = row;
  visit_each(visit,
             {"subject", "processes", "most_at_once", "peak_bytes", "peak_shared", "crashes", "over_time",
              "over_memory", "broke_protocol"},
             subject, processes, at_once, bytes, shared, crashes, time, memory, protocol);
}
static void visit_fields(Is<Result> auto& row, auto&& visit) {
  auto& [subject, mesh, check, depth, depths, sample, precision, scheme, cut, weights, status, bad, of, worst,
         bound, rms, p99, unit, absolute, ulps, ill, witness, message, accepted, not_finite, file_options,
         waiver, places, decades, seconds, recognised, origin] = row;
  visit_each(
      visit,
      {"subject",    "mesh",    "depth",   "depths",         "sample",     "scheme",          "triangulated",
       "precision",  "check",   "status",  "count",          "of",         "worst",           "bound",
       "unit",       "rms",     "p99",     "worst_absolute", "worst_ulps", "ill_conditioned", "places",
       "recognised", "seconds", "message", "witness",        "origin"},
      subject, mesh, depth, depths, sample, scheme, cut, precision, check, status, bad, of, worst, bound,
      unit, rms, p99, absolute, ulps, ill, places, recognised, seconds, message, witness, origin);
  visit_each(visit, weights, decades, accepted, not_finite, waiver, file_options);
}

namespace {

using Ordered = nlohmann::ordered_json;
using Json = nlohmann::json;

// As a report has it: what does not apply, or is no number, is null.
template <class T>
Ordered shown(const T& x) {
  if constexpr (std::is_same_v<T, std::string>) {
    return x.empty() ? Ordered(nullptr) : Ordered(x);
  } else if constexpr (std::is_same_v<T, bool>) {
    return x;
  } else if constexpr (std::is_integral_v<T>) {
    return x >= 0 ? Ordered(x) : Ordered(nullptr);
  } else if constexpr (std::is_floating_point_v<T>) {
    return std::isfinite(x) ? Ordered(x) : Ordered(nullptr);
  } else if constexpr (std::is_enum_v<T>) {
    return word(x);
  } else if constexpr (kIsOptional<T>) {
    return x ? shown(*x) : Ordered(nullptr);
  } else if constexpr (std::is_same_v<T, std::vector<double>>) {
    return numbers(x);
  } else if constexpr (kIsList<T>) {
    if (x.empty()) return nullptr;
    Ordered list = Ordered::array();
    for (const auto& element : x) list.push_back(shown(element));
    return list;
  } else {
    Ordered object = Ordered::object();
    visit_fields(x, [&](const char* name, const auto& member) {
      if (*name != '\0') object[name] = shown(member);
    });
    return object;
  }
}

Ordered changes(const Report& report) {
  if (!report.changes) return nullptr;
  const auto& c = *report.changes;
  return {{"baseline", c.baseline}, {"new", c.appeared}, {"worse", c.worse},
          {"gone", c.gone},         {"same", c.same},    {"named", c.named}};
}

// With the commands that show its witness.
Ordered row_json(const Result& r, int cause, const std::string& level) {
  Ordered row = shown(r), witness = std::move(row["witness"]);
  row.erase("witness");
  row["cause"] = shown(cause);
  if (r.witness) {
    witness["command"] = shown(eval_command(r));
    witness["difference"] = shown(difference_command(r));
    witness["reproduce"] = is_bad(r) ? Ordered(audit_command(r, level)) : Ordered(nullptr);
  }
  row["witness"] = std::move(witness);
  return row;
}

}  // namespace

Ordered cause_json(const Report& report, const Cause& c, int number, const std::string& level) {
  const Result& example = report.results[c.example];
  return {{"number", number},
          {"who", c.who},
          {"kind", word(c.kind)},
          {"severity", c.severity()},
          {"title", c.title},
          {"look", shown(c.look)},
          {"subjects", c.subjects},
          {"cases", c.cases},
          {"of", c.of},
          {"rows", c.rows.size()},
          {"consequences", c.consequences},
          {"mesh", example.mesh},
          {"depth", example.depth},
          {"depths", shown(example.depths)},
          {"command", shown(command_for(report, c, level))}};
}

Ordered numbers(const std::vector<double>& list) {
  if (list.empty()) return nullptr;
  Ordered out = Ordered::array();
  for (const double x : list) out.push_back(number(x));
  return out;
}

std::string to_json(const Report& report, const std::string& level, bool all_rows) {
  Ordered out{{"program", "limitcheck audit"},
              {"version", report.version},
              {"depth", report.depth},
              {"depths", report.depths},
              {"seed", report.seed ? Ordered(*report.seed) : Ordered(nullptr)},
              {"sample", shown(report.sample)},
              {"seconds", report.seconds},
              {"held", report.held()},
              {"containment", shown(report.containment)},
              {"receipts", Ordered::array()},
              {"incomplete", shown(report.incomplete)},
              {"left_out", report.left_out},
              {"rerun", shown(report.rerun)},
              {"printed", shown(report.printed)},
              {"changes", changes(report)},
              {"never_judged", Ordered::array()}};
  for (const Receipt& r : report.receipts) out["receipts"].push_back(shown(r));
  for (const auto& [subject, device] : report.devices) out["devices"][subject] = device;
  for (const Unjudged& none : unjudged(report))
    out["never_judged"].push_back(
        {{"subject", none.subject}, {"check", none.check}, {"reason", shown(none.reason)}});
  out["coverage"] = Ordered::array();
  for (const Coverage& c : report.coverage) {
    constexpr std::size_t kNamed = 100;
    std::vector<std::string> named = c.never;
    named.resize(std::min(kNamed, named.size()));
    out["coverage"].push_back({{"subject", c.subject},
                               {"scheme", data::name_of(c.scheme)},
                               {"looked_at", c.looked},
                               {"declared", c.declared()},
                               {"not_declared", c.not_declared},
                               {"never", named}});
  }
  out["exhaustive"] = Ordered::array();
  for (const Exhaustive& e : exhaustive_of(report.results))
    out["exhaustive"].push_back({{"subject", e.subject},
                                 {"scheme", data::name_of(e.scheme)},
                                 {"valence", e.most},
                                 {"neighbourhoods", e.neighbourhoods},
                                 {"looked_at", e.looked},
                                 {"cases", e.cases},
                                 {"wrong_cases", e.wrong},
                                 {"right", e.all_right()},
                                 {"examples", e.examples}});
  out["subjects"] = report.subjects;
  out["meshes"] = Ordered::array();
  for (const Report::Mesh& m : report.meshes) out["meshes"].push_back(shown(m));
  std::vector<int> cause_of(report.results.size(), -1);
  out["causes"] = Ordered::array();
  for (const Cause& c : causes(report)) {
    const int number = static_cast<int>(out["causes"].size()) + 1;
    for (const std::size_t k : c.rows) cause_of[k] = number;
    out["causes"].push_back(cause_json(report, c, number, level));
  }
  out["results"] = Ordered::array();
  const std::vector<bool> full =
      all_rows ? std::vector<bool>(report.results.size(), true) : rows_in_full(report);
  for (std::size_t k = 0; k < report.results.size(); ++k)
    if (full[k]) out["results"].push_back(row_json(report.results[k], cause_of[k], level));
  if (std::ranges::count(full, false) > 0) out["in_short"] = in_short(report, full);
  return out.dump(1, ' ', false, Ordered::error_handler_t::replace) + "\n";
}

Result reported_row(const Json& json) {
  Result row;
  read(json, row);
  row.check = current_name(row.check);
  return row;
}

Json rows_json(const std::vector<Result>& rows) {
  return kept(rows);
}

std::vector<Result> rows_of(const Json& json) {
  std::vector<Result> rows;
  for (const Json& row : json) rows.push_back(reported_row(row));
  return rows;
}

Json receipts_json(const std::vector<Receipt>& receipts) {
  return kept(receipts);
}

std::vector<Receipt> receipts_of(const Json& json) {
  std::vector<Receipt> all;
  for (const Json& one : json) {
    Receipt receipt;
    read(one, receipt);
    visit_fields(receipt, [](const char* name, const auto& count) {
      if constexpr (std::is_integral_v<std::remove_cvref_t<decltype(count)>>)
        if (count < 0 || count > std::int64_t{1} << 50)
          throw data::ArgumentError(fmt::format("a receipt of {} {}", count, name));
    });
    add(all, receipt);
  }
  return all;
}

static void visit_header(auto& r, auto&& visit) {
  visit_each(visit,
             {"version", "depth", "depths", "seed", "sample", "meshes", "left_out", "rerun", "subjects",
              "descriptions"},
             r.version, r.depth, r.depths, r.seed, r.sample, r.meshes, r.left_out, r.rerun, r.subjects,
             r.descriptions);
}

Json header_json(const Report& report) {
  Json json;
  visit_header(report, [&](const char* name, const auto& member) { json[name] = kept(member); });
  return json;
}

Report header_of(const Json& json) {
  Report report;
  visit_header(report, [&](const char* name, auto& member) { read(json.at(name), member); });
  return report;
}

void write_text(const std::filesystem::path& file, const std::string& content) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  data::AtomicFile out(file);
  out.stream() << content;
  out.commit();
}

}  // namespace limitcheck::verify
