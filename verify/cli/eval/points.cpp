// SPDX-License-Identifier: MIT
#include <fmt/compile.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/error.h"
#include "reference/surface/surface.h"
#include "verify/cli/eval/eval.h"

namespace limitcheck::cli {
namespace {

using reference::Enclosure, reference::Enclosure3, reference::Parameter, reference::Vec3;

constexpr std::size_t kBlock = std::size_t{4} << 20;  // of the input, read at a time
constexpr std::size_t kPart = std::size_t{16} << 10;  // of a block, one after the other

struct Column {
  const char* name;
  bool vector;
};
std::vector<Column> columns_of(const EvalRequest& request) {
  std::vector<Column> columns{{"position", true}};
  if (request.derivatives > 0) columns.insert(columns.end(), {{"normal", true}, {"d1", true}, {"d2", true}});
  if (request.derivatives > 1)
    columns.insert(columns.end(), {{"d11", true},
                                   {"d12", true},
                                   {"d22", true},
                                   {"gaussian_curvature", false},
                                   {"mean_curvature", false}});
  if (request.certified) columns.push_back({"radius", false});
  return columns;
}
std::string header_of(const std::vector<Column>& columns) {
  std::string line = "face,u,v";
  for (const auto& [name, vector] : columns)
    line += !vector                                ? fmt::format(",{}", name)
            : std::string_view(name) == "position" ? ",x,y,z"
                                                   : fmt::format(",{0}_x,{0}_y,{0}_z", name);
  return line + "\n";
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  return first == text.npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// A line of the input.
struct Given {
  std::string_view face, u, v;
  FaceAndCorner at;
};
// Throws data::ArgumentError.
Given given(std::string_view line) {
  const auto first = line.find(','), second = line.find(',', std::min(first, line.size() - 1) + 1);
  if (first == line.npos || second == line.npos || line.find(',', second + 1) != line.npos)
    throw data::ArgumentError(fmt::format("a line is FACE,U,V, not '{}'", line));
  Given g{trimmed(line.substr(0, first)),
          trimmed(line.substr(first + 1, second - first - 1)),
          trimmed(line.substr(second + 1)),
          {}};
  g.at = parse_face(std::string(g.face));
  return g;
}

// "0.25", "1/3".
double number_of(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  if (const auto read = std::from_chars(text.data(), end, value); read.ec == std::errc() && read.ptr == end)
    return value;
  return Parameter::parse(text).as_double();
}

// The values of the columns, one after the other.
using Doubles = std::vector<double>;
void add(Doubles& values, const Vec3<double>& v, bool exists) {
  for (const double x : {v.x, v.y, v.z})
    values.push_back(exists ? x : std::numeric_limits<double>::quiet_NaN());
}
Doubles doubles(const EvalRequest& request, const reference::Surface& surface, const Given& g) {
  const auto p = surface.evaluate(static_cast<int>(g.at.face), g.at.corner.value_or(0), number_of(g.u),
                                  number_of(g.v), static_cast<reference::Derivatives>(request.derivatives));
  Doubles values;
  add(values, p.position, true);
  if (request.derivatives > 0) {
    add(values, p.normal, true);
    add(values, p.d1, p.first_exist);
    add(values, p.d2, p.first_exist);
  }
  if (request.derivatives > 1) {
    for (const auto& d : {p.d11, p.d12, p.d22}) add(values, d, p.second_exist);
    const double e = dot(p.d1, p.d1), f = dot(p.d1, p.d2), h = dot(p.d2, p.d2), l = dot(p.d11, p.normal),
                 m = dot(p.d12, p.normal), n = dot(p.d22, p.normal), area = e * h - f * f;
    const bool exist = p.first_exist && p.second_exist;
    values.push_back(exist ? (l * n - m * m) / area : std::numeric_limits<double>::quiet_NaN());
    values.push_back(exist ? -(e * n - 2 * f * m + h * l) / (2 * area)
                           : std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

// Decimals; empty where nothing exists.
using Decimals = std::vector<std::string>;
Decimals decimals(const EvalRequest& request, const reference::CertifiedEvaluator& evaluator,
                  const Given& g) {
  const auto p = evaluator.evaluate(static_cast<int>(g.at.face), g.at.corner.value_or(0),
                                    Parameter::parse(g.u), Parameter::parse(g.v), request.digits);
  Decimals values;
  const auto put = [&](const Enclosure3& v, bool exists = true) {
    for (const Enclosure& x : v) values.push_back(exists ? x.value : "");
  };
  const auto put_maybe = [&](const std::optional<Enclosure3>& v) {
    put(v.value_or(Enclosure3{}), v.has_value());
  };
  put(p.position);
  if (request.derivatives > 0) put(p.normal), put(p.d1, p.first_exist), put(p.d2, p.first_exist);
  if (request.derivatives > 1) {
    put_maybe(p.d11), put_maybe(p.d12), put_maybe(p.d22);
    for (const auto& k : {p.gaussian_curvature, p.mean_curvature}) values.push_back(k ? k->value : "");
  }
  values.push_back(p.radius.to_string());
  return values;
}

using Text = fmt::memory_buffer;
void append(Text& to, std::string_view text) {
  to.append(text.data(), text.data() + text.size());
}
void put_value(Text& to, double x, bool json) {
  if (json && !std::isfinite(x)) return append(to, "null");
  fmt::format_to(std::back_inserter(to), FMT_COMPILE("{}"), x);
}
void put_value(Text& to, const std::string& x, bool json) {
  if (json && x.empty()) return append(to, "null");
  if (json) append(to, "\"");
  append(to, x);
  if (json) append(to, "\"");
}

template <class Values>
void put_line(Text& to, const std::vector<Column>& columns, const Given& g, const Values& values, bool json) {
  if (!json) {
    for (const std::string_view field : {g.face, g.u, g.v}) append(to, field), append(to, ",");
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (k > 0) append(to, ",");
      put_value(to, values[k], false);
    }
    return append(to, "\n");
  }
  fmt::format_to(std::back_inserter(to), "{{\"face\": {}, \"corner\": {}, \"u\": \"{}\", \"v\": \"{}\"",
                 g.at.face, g.at.corner ? fmt::format("{}", *g.at.corner) : "null", g.u, g.v);
  std::size_t next = 0;
  for (const auto& [name, vector] : columns) {
    fmt::format_to(std::back_inserter(to), ", \"{}\": {}", name, vector ? "[" : "");
    for (int k = 0; k < (vector ? 3 : 1); ++k) {
      if (k > 0) append(to, ", ");
      put_value(to, values[next++], true);
    }
    if (vector) append(to, "]");
  }
  append(to, "}\n");
}

// Some lines of a block, the number of the first, and what became of them.
struct Part {
  std::string_view lines;
  std::int64_t first;
  Text text{};
  std::exception_ptr error{};
};

std::vector<Part> parts_of(std::string_view block, std::int64_t& line) {
  std::vector<Part> parts;
  while (!block.empty()) {
    const std::size_t end = block.find('\n', std::min(kPart, block.size() - 1));
    const std::string_view lines = block.substr(0, end == block.npos ? block.size() : end + 1);
    parts.push_back({lines, line});
    line += std::count(lines.begin(), lines.end(), '\n');
    block.remove_prefix(lines.size());
  }
  return parts;
}

// Calls answer(line, text) for each line that is no comment, and a header if it is the first; the error names the line.
template <class Answer>
void run(Part& part, const std::string& file, const Answer& answer) {
  std::int64_t number = part.first;
  for (std::string_view rest = part.lines; !rest.empty() && !part.error; ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size() - 1);
    const std::string_view line = trimmed(rest.substr(0, rest[end] == '\n' ? end : end + 1));
    rest.remove_prefix(end + 1);
    if (line.empty() || line[0] == '#' ||
        (number == 1 && std::isalpha(static_cast<unsigned char>(line[0])) != 0))
      continue;
    try {
      answer(line, part.text);
    } catch (const data::Error& error) {
      part.error = std::make_exception_ptr(data::InputError("POINT_UNUSABLE", file, number, error.what()));
    } catch (...) {
      part.error = std::current_exception();
    }
  }
}

}  // namespace

void evaluate_points(const EvalRequest& request, const OpenedMesh& opened) {
  const bool is_file = request.points != "-";
  std::ifstream opened_file;
  if (is_file) opened_file.open(request.points, std::ios::binary);
  std::istream& in = is_file ? opened_file : std::cin;
  const std::string name = is_file ? request.points : "standard input";
  if (!in) throw data::InputError("FILE_NOT_READABLE", name, 0, "cannot be read");

  const std::vector<Column> columns = columns_of(request);
  std::unique_ptr<reference::CertifiedEvaluator> certified;
  std::unique_ptr<reference::Surface> surface;
  if (request.certified)
    certified.reset(
        new reference::CertifiedEvaluator(certified_evaluator(request, opened)));  // it cannot be moved
  else
    surface = std::make_unique<reference::Surface>(opened.mesh, opened.chosen.scheme, request.weights);
  const auto answer = [&](std::string_view line, Text& to) {
    const Given g = given(line);
    check_face(request, opened, g.at);
    if (certified)
      put_line(to, columns, g, decimals(request, *certified, g), request.json);
    else
      put_line(to, columns, g, doubles(request, *surface, g), request.json);
  };

  if (!request.json) say_text(stdout, header_of(columns));
  std::string block, left;
  std::int64_t line = 1;
  do {
    block = std::move(left);
    const std::size_t kept = block.size();
    block.resize(kept + kBlock);
    in.read(block.data() + kept, kBlock);
    block.resize(kept + static_cast<std::size_t>(in.gcount()));
    const std::size_t whole = in ? block.rfind('\n') + 1 : block.size();
    left = block.substr(whole);
    block.resize(whole);
    std::vector<Part> parts = parts_of(block, line);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) { run(parts[k], name, answer); });
    for (const Part& part : parts) {
      say_text(stdout, std::string(part.text.data(), part.text.size()));
      if (part.error) std::rethrow_exception(part.error);
    }
  } while (in);
  if (in.bad()) throw data::InputError("FILE_NOT_READABLE", name, 0, "cannot be read");
}

}  // namespace limitcheck::cli
