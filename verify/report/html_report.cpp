// SPDX-License-Identifier: MIT

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "verify/report/forms.h"
#include "verify/row/commands.h"
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
  return {{"control", base64(shape->control)}, {"positions", base64(shape->positions)},
          {"values", base64(shape->values)},   {"triangles", base64(shape->triangles)},
          {"witness", shape->witness},         {"note", shape->note}};
}

// The errors of each subject, over all meshes.
Json errors(const Report& report) {
  Json list = Json::array();
  for (const std::string& subject : report.subjects)
    for (const bool normals : {false, true}) {
      std::vector<std::int64_t> counts(kDecades, 0);
      double bound = 0;
      for (const Result& r : report.results) {
        if (r.subject != subject || (r.unit == "degrees") != normals || r.decades.size() != counts.size())
          continue;
        std::transform(counts.begin(), counts.end(), r.decades.begin(), counts.begin(), std::plus<>());
        bound = std::max(bound, r.bound.value_or(0));
      }
      if (*std::max_element(counts.begin(), counts.end()) > 0)
        list.push_back({{"subject", subject},
                        {"of", normals ? "normals" : "positions"},
                        {"bound", bound > 0 ? Json(bound) : Json(nullptr)},
                        {"counts", counts}});
    }
  return list;
}

// Overview and causes for who runs no script.
std::string plain(const Json& data) {
  const auto row = [](const char* cell, const std::string& first, const Json& rest) {
    std::string out = fmt::format("<tr><{0}>{1}</{0}>", cell, xml_text(first));
    for (const Json& text : rest)
      out += fmt::format("<{0}>{1}</{0}>", cell, xml_text(text.get<std::string>()));
    return out + "</tr>\n";
  };
  std::string out = fmt::format("<p>{}</p>\n<table>\n", xml_text(data["about"].get<std::string>()));
  out += row("th", "subject", data["groups"]);
  for (std::size_t k = 0; k < data["subjects"].size(); ++k)
    out += row("td", data["subjects"][k].get<std::string>(), data["matrix"][k]);
  out += fmt::format("</table>\n<p>{}</p>\n<ol>\n", xml_text(data["legend"].get<std::string>()));
  for (const Json& c : data["causes"])
    out += fmt::format("<li>{}, {}: {} <code>{}</code></li>\n", xml_text(c["severity"].get<std::string>()),
                       xml_text(c["who"].get<std::string>()), xml_text(c["title"].get<std::string>()),
                       xml_text(c["command"].get<std::string>()));
  return out + "</ol>";
}

void put(std::string& page, std::string_view place, const std::string& text) {
  page.replace(page.find(place), place.size(), text);
}

}  // namespace

std::string to_html(const Report& report, const std::vector<Cause>& causes,
                    const std::vector<std::optional<ErrorShape>>& shapes, const std::string& level) {
  Json data{{"about", header(report) + changes_line(report) + waiver_lines(report) + summary(report)},
            {"legend", legend(report)},
            {"groups", Json::array()},
            {"subjects", report.subjects},
            {"matrix", Json::array()},
            {"causes", Json::array()},
            {"first", kFirstDecade},
            {"errors", errors(report)}};
  for (const CheckGroup& g : check_groups(report)) data["groups"].push_back(g.title);
  for (const std::string& subject : report.subjects) {
    Json row = Json::array();
    for (const CheckGroup& g : check_groups(report)) row.push_back(verdict_of(report, subject, g).text());
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
  // In this order: names of subjects may be anything, and what is put in first lies behind the other place.
  put(page, "%DATA%", text);
  put(page, "%PLAIN%", plain(data));
  return page;
}

}  // namespace limitcheck::verify
