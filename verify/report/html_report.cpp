// SPDX-License-Identifier: MIT
#include "verify/report/html_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "verify/report/html_page.h"
#include "verify/report/overview.h"
#include "verify/row/case_names.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
std::string base64(const std::vector<T>& list) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto bytes = std::as_bytes(std::span(list));
  std::string out;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const auto byte = [&](std::size_t j) {
      return j < bytes.size() ? std::to_integer<std::uint32_t>(bytes[j]) : 0U;
    };
    const std::uint32_t word = byte(k) << 16 | byte(k + 1) << 8 | byte(k + 2);
    for (std::size_t digit = 0; digit < 4; ++digit)
      out += k + digit <= bytes.size() ? kDigits[(word >> (18 - 6 * digit)) & 63U] : '=';
  }
  return out;
}

Json shape_json(const std::optional<ErrorShape>& shape) {
  if (!shape) return nullptr;
  return {{"positions", base64(shape->positions)},
          {"values", base64(shape->values)},
          {"triangles", base64(shape->triangles)},
          {"witness", shape->witness},
          {"note", shape->note}};
}

// The errors of each subject, over all meshes.
Json errors(const Report& report) {
  Json list = Json::array();
  for (const std::string& subject : report.subjects)
    for (const bool normals : {false, true}) {
      std::vector<std::int64_t> counts(kDecades, 0);
      for (const Result& r : report.results)
        if (r.subject == subject && (r.check == "normals") == normals && r.decades.size() == counts.size())
          std::transform(counts.begin(), counts.end(), r.decades.begin(), counts.begin(), std::plus<>());
      if (*std::max_element(counts.begin(), counts.end()) > 0)
        list.push_back({{"subject", subject}, {"of", normals ? "normals" : "positions"}, {"counts", counts}});
    }
  return list;
}

}  // namespace

std::string to_html(const Report& report, const std::vector<Cause>& causes,
                    const std::vector<std::optional<ErrorShape>>& shapes, const std::string& level) {
  Json data{{"about", header(report) + changes_line(report) + waiver_lines(report) + summary(report)},
            {"legend", legend(report.depths == "plan")},
            {"groups", Json::array()},
            {"subjects", report.subjects},
            {"matrix", Json::array()},
            {"causes", Json::array()},
            {"first", kFirstDecade},
            {"errors", errors(report)}};
  for (const CheckGroup& g : check_groups()) data["groups"].push_back(g.title);
  for (const std::string& subject : report.subjects) {
    Json row = Json::array();
    for (const CheckGroup& g : check_groups()) row.push_back(verdict_of(report, subject, g).text());
    data["matrix"].push_back(std::move(row));
  }
  for (std::size_t k = 0; k < causes.size(); ++k) {
    const Cause& c = causes[k];
    data["causes"].push_back({{"who", c.who},
                              {"severity", c.severity()},
                              {"title", c.title},
                              {"subjects", c.subjects},
                              {"look", c.look},
                              {"consequences", c.consequences},
                              {"cases", c.cases},
                              {"of", c.of},
                              {"mesh", case_name(report, report.results[c.example])},
                              {"command", command_for(report, c, level)},
                              {"shape", shape_json(k < shapes.size() ? shapes[k] : std::nullopt)}});
  }
  std::string text = data.dump(-1, ' ', true, Json::error_handler_t::replace);
  // Nothing in it ends the script element.
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  std::string page = kHtmlPage;
  constexpr std::string_view kPlace = "%DATA%";
  return page.replace(page.find(kPlace), kPlace.size(), text);
}

}  // namespace limitcheck::verify
