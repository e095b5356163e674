// SPDX-License-Identifier: MIT
#include <fmt/compile.h>
#include <fmt/format.h>
#include <tbb/info.h>
#include <tbb/parallel_pipeline.h>

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
#include <string_view>

#include "data/error.h"
#include "reference/surface/channel.h"
#include "reference/surface/surface.h"
#include "verify/cli/eval/eval.h"

namespace limitcheck::cli {
namespace {

using reference::CertifiedPoint, reference::Enclosure3, reference::Parameter, reference::Vec3;

constexpr std::size_t kPart = std::size_t{16}
                              << 10;  // bytes of the input that are answered one after the other

struct Column {
  const char* name;
  std::size_t width = 1;
};
std::vector<Column> columns_of(const EvalRequest& request, std::size_t components) {
  const bool channel = !request.channel.empty();
  std::vector<Column> columns{{channel ? "value" : "position", components}};
  if (request.derivatives > 0) {
    if (!channel) columns.push_back({"normal", components});
    columns.insert(columns.end(), {{"d1", components}, {"d2", components}});
  }
  if (request.derivatives > 1) {
    columns.insert(columns.end(), {{"d11", components}, {"d12", components}, {"d22", components}});
    if (!channel) columns.insert(columns.end(), {{"gaussian_curvature"}, {"mean_curvature"}});
  }
  if (request.certified) columns.push_back({"radius"});
  return columns;
}
// Coordinates are called x, y, z; components of a channel have numbers.
std::string header_of(const std::vector<Column>& columns, bool channel) {
  std::string line = "face,u,v";
  for (const auto& [name, width] : columns)
    for (std::size_t k = 0; k < width; ++k) {
      const std::string component = channel ? std::to_string(k) : std::string(1, "xyz"[k]);
      line += name == std::string_view("position") ? "," + component
              : width > 1 || channel               ? fmt::format(",{}_{}", name, component)
                                                   : fmt::format(",{}", name);
    }
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

// Decimals; empty where nothing exists. Of a channel of more than three components there are two points.
using Decimals = std::vector<std::string>;
Decimals decimals(const EvalRequest& request, const std::vector<CertifiedPoint>& points,
                  std::size_t components) {
  const CertifiedPoint& p = points[0];
  const bool channel = !request.channel.empty();
  Decimals values;
  const auto put = [&](Enclosure3 CertifiedPoint::*vector, bool exists = true) {
    for (std::size_t k = 0; k < components; ++k)
      values.push_back(exists ? (points[k / 3].*vector)[k % 3].value : "");
  };
  const auto put_maybe = [&](std::optional<Enclosure3> CertifiedPoint::*vector) {
    for (std::size_t k = 0; k < components; ++k)
      values.push_back(p.*vector ? (*(points[k / 3].*vector))[k % 3].value : "");
  };
  put(&CertifiedPoint::position);
  if (request.derivatives > 0) {
    if (!channel) put(&CertifiedPoint::normal);
    put(&CertifiedPoint::d1, p.first_exist), put(&CertifiedPoint::d2, p.first_exist);
  }
  if (request.derivatives > 1) {
    put_maybe(&CertifiedPoint::d11), put_maybe(&CertifiedPoint::d12), put_maybe(&CertifiedPoint::d22);
    if (!channel)
      for (const auto& k : {p.gaussian_curvature, p.mean_curvature}) values.push_back(k ? k->value : "");
  }
  if (request.certified) {
    reference::Radius largest;
    for (const CertifiedPoint& point : points) largest = std::max(largest, point.radius);
    values.push_back(largest.to_string());
  }
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
  for (const auto& [name, width] : columns) {
    // Curvatures and the radius are numbers, all else is a vector, of one component, too.
    const bool vector = width > 1 || std::string_view(name).find_first_of("_r") == std::string_view::npos;
    fmt::format_to(std::back_inserter(to), ", \"{}\": {}", name, vector ? "[" : "");
    for (std::size_t k = 0; k < width; ++k) {
      if (k > 0) append(to, ", ");
      put_value(to, values[next++], true);
    }
    if (vector) append(to, "]");
  }
  append(to, "}\n");
}

// Some lines of the input, the number of the first, and what became of them.
struct Part {
  std::string lines;
  std::int64_t first;
  Text text{};
  std::exception_ptr error{};
};

// The next of them; no lines: there are none left.
std::shared_ptr<Part> next_part(std::istream& in, std::int64_t& line) {
  const auto part = std::make_shared<Part>(Part{std::string(kPart, '\0'), line});
  in.read(part->lines.data(), kPart);
  part->lines.resize(static_cast<std::size_t>(in.gcount()));
  if (std::string rest; std::getline(in, rest)) part->lines += rest + "\n";
  line += std::ranges::count(part->lines, '\n');
  return part;
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

  std::size_t components = 3;
  std::unique_ptr<reference::ChannelEvaluator> channel;
  std::unique_ptr<reference::CertifiedEvaluator> certified;
  std::unique_ptr<reference::Surface> surface;
  if (!request.channel.empty()) {
    const ChosenChannel chosen = channel_of(request, opened);
    components = static_cast<std::size_t>(chosen.channel.components);
    channel = std::make_unique<reference::ChannelEvaluator>(opened.mesh, chosen.channel, chosen.rule,
                                                            opened.chosen.scheme);
  } else if (request.certified) {
    certified.reset(
        new reference::CertifiedEvaluator(certified_evaluator(request, opened)));  // it cannot be moved
  } else {
    surface = std::make_unique<reference::Surface>(opened.mesh, opened.chosen.scheme, request.weights);
  }
  const std::vector<Column> columns = columns_of(request, components);
  const auto answer = [&](std::string_view line, Text& to) {
    const Given g = given(line);
    check_face(request, opened, g.at);
    if (surface) return put_line(to, columns, g, doubles(request, *surface, g), request.json);
    const auto face = static_cast<int>(g.at.face);
    const int corner = g.at.corner.value_or(0);
    const Parameter u = Parameter::parse(g.u), v = Parameter::parse(g.v);
    const std::vector<CertifiedPoint> points =
        channel ? channel->evaluate(face, corner, u, v, request.digits)
                : std::vector{certified->evaluate(face, corner, u, v, request.digits)};
    put_line(to, columns, g, decimals(request, points, components), request.json);
  };

  if (!request.json) say_text(stdout, header_of(columns, channel != nullptr));
  std::int64_t line = 1;
  using tbb::filter_mode, tbb::make_filter;
  using Lines = std::shared_ptr<Part>;
  tbb::parallel_pipeline(
      4 * static_cast<std::size_t>(tbb::info::default_concurrency()),
      make_filter<void, Lines>(filter_mode::serial_in_order, [&](tbb::flow_control& control) {
        Lines part = next_part(in, line);
        if (part->lines.empty()) control.stop();
        return part;
      }) & make_filter<Lines, Lines>(filter_mode::parallel, [&](Lines part) {
        run(*part, name, answer);
        return part;
      }) & make_filter<Lines, void>(filter_mode::serial_in_order, [](const Lines& part) {
        say_text(stdout, std::string(part->text.data(), part->text.size()));
        if (part->error) std::rethrow_exception(part->error);
      }));
  if (in.bad()) throw data::InputError("FILE_NOT_READABLE", name, 0, "cannot be read");
}

}  // namespace limitcheck::cli
