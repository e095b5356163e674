// SPDX-License-Identifier: MIT
#include "verify/shader/source.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <string_view>
#include <utility>

#include "data/error.h"
#include "data/io/whole_content.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::verify {

namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw SubjectError(LC_INVALID_INPUT, why);
}

// expression = term (('+' | '-') term)*, and so on; every step is checked against the largest value.
class Parser {
 public:
  Parser(std::string_view text, const MeshCounts& counts) : all_(text), left_(text), counts_(counts) {}

  std::int64_t whole() {
    const std::int64_t value = sum();
    if (!left_.empty()) wrong();
    return value;
  }

 private:
  static constexpr std::int64_t kMost = std::int64_t{1} << 40;

  [[noreturn]] void wrong() const {
    refuse(
        fmt::format("'{}' is no number of the mesh: V F C E, V(level) and the like, d, level, + - * / ^, "
                    "up to 2^40, without blanks",
                    all_));
  }
  std::int64_t checked(std::int64_t value) const {
    if (value > kMost || value < -kMost) wrong();
    return value;
  }
  std::int64_t times(std::int64_t a, std::int64_t b) const {
    std::int64_t value = 0;
    return checked(__builtin_mul_overflow(a, b, &value) ? kMost + 1 : value);
  }
  bool take(std::string_view word) {
    if (!left_.starts_with(word)) return false;
    left_.remove_prefix(word.size());
    return true;
  }
  std::int64_t sum() { return chain(&Parser::product, "+-"); }
  std::int64_t product() { return chain(&Parser::power, "*/"); }
  std::int64_t chain(std::int64_t (Parser::*operand)(), std::string_view signs) {
    std::int64_t value = (this->*operand)();
    while (!left_.empty() && signs.find(left_[0]) != std::string_view::npos) {
      const char sign = left_[0];
      left_.remove_prefix(1);
      const std::int64_t other = (this->*operand)();
      if (sign == '/' && other == 0) wrong();
      value = sign == '*'   ? times(value, other)
              : sign == '/' ? value / other
                            : checked(sign == '+' ? value + other : value - other);
    }
    return value;
  }
  std::int64_t power() {
    const std::int64_t base = one();
    if (!take("^")) return base;
    const std::int64_t exponent = power();
    if (exponent < 0 || exponent > 64) wrong();
    std::int64_t value = 1;
    for (std::int64_t k = 0; k < exponent; ++k) value = times(value, base);
    return value;
  }
  std::int64_t bracket() {
    if (++depth_ > 50) wrong();
    const std::int64_t value = sum();
    if (!take(")")) wrong();
    --depth_;
    return value;
  }
  std::int64_t one() {
    if (take("(")) return bracket();
    if (take("level")) return counts_.level;
    if (take("d")) return counts_.depth;
    constexpr std::string_view kNames = "VFCE";
    for (std::size_t k = 0; k < kNames.size(); ++k)
      if (take(kNames.substr(k, 1))) {
        const std::int64_t steps = take("(") ? bracket() : 0;
        if (steps < 0 || steps > 16) wrong();
        return checked(counts_.after(steps)[k]);
      }
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(left_.data(), left_.data() + left_.size(), value);
    if (error != std::errc{} || value < 0) wrong();
    left_.remove_prefix(static_cast<std::size_t>(end - left_.data()));
    return checked(value);
  }

  std::string_view all_, left_;
  const MeshCounts& counts_;
  int depth_ = 0;
};

using Words = std::vector<std::string>;

// The words behind `#pragma limitcheck`; false if the line is another.
bool pragma(const std::string& line, Words& words) {
  std::istringstream in(line);
  std::string word;
  if (!(in >> word) || (word == "#" && !(in >> word)) || (word != "#pragma" && word != "pragma") ||
      !(in >> word) || word != "limitcheck")
    return false;
  while (in >> word && !word.starts_with("//")) words.push_back(word);
  return true;
}

// The flags of these words or-ed.
std::int32_t flags(const Words& words,
                   std::initializer_list<std::pair<std::string_view, std::int32_t>> known) {
  std::int32_t all = 0;
  std::vector<std::string_view> names;
  for (const auto& [name, flag] : known) names.push_back(name);
  for (std::size_t k = 1; k < words.size(); ++k) {
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const auto& entry) { return entry.first == words[k]; });
    if (found == known.end())
      refuse(fmt::format("'{}' after '{}': {}", words[k], words[0], fmt::join(names, ", ")));
    all |= found->second;
  }
  if (words.size() < 2) refuse(fmt::format("'{}' needs one of: {}", words[0], fmt::join(names, ", ")));
  return all;
}

void need(const Words& words, std::size_t least, std::size_t most, const char* form) {
  if (words.size() < least || words.size() > most) refuse(fmt::format("write {}", form));
}

std::int32_t integer(const std::string& text, std::int32_t least, std::int32_t most) {
  std::int32_t value = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || *end != '\0' || value < least || value > most)
    refuse(fmt::format("'{}': a number from {} to {}", text, least, most));
  return value;
}

Formula formula(const std::string& text) {
  Formula read(text);
  // What it is of real meshes shows there; here, whether it is one at all.
  (void)read.value({LC_SCHEME_CATMULL_CLARK, {4, 1, 4, 4}, 3, 2});
  return read;
}

void take(ShaderSource& s, const Words& words) {
  using Form = ShaderSource::Form;
  if (words.empty()) refuse("a pragma that says nothing");
  const std::string& key = words[0];
  if (key == "scheme") {
    s.schemes = flags(words, {{"loop", LC_DOES_LOOP},
                              {"catmull-clark", LC_DOES_CATMULL_CLARK},
                              {"both", LC_DOES_LOOP | LC_DOES_CATMULL_CLARK}});
  } else if (key == "sharp") {
    s.sharp = flags(words, {{"creases", LC_SHARP_CREASES},
                            {"semi-sharp", LC_SHARP_SEMI},
                            {"corners", LC_SHARP_CORNERS},
                            {"no-darts", LC_SHARP_NO_DARTS}});
  } else if (key == "points") {
    s.points = flags(words, {{"limit", 0}, {"refined", 1}}) == 0 ? LC_POINTS_LIMIT : LC_POINTS_REFINED;
  } else if (key == "weights") {
    s.weights = flags(words, {{"loop", 0}, {"warren", 1}}) == 0 ? LC_WEIGHTS_LOOP : LC_WEIGHTS_WARREN;
  } else if (key == "boundary") {
    s.boundary = flags(words, {{"spline", 0}, {"none", 1}}) == 0 ? LC_BOUNDARY_SPLINE : LC_BOUNDARY_NONE;
  } else if (key == "faces") {
    s.quads_only = flags(words, {{"any", 0}, {"quads", 1}}) == 1;
  } else if (key == "no-normals" || key == "approximate" || key == "tessellate") {
    need(words, 1, 1, key.c_str());
    if (key == "no-normals") s.normals = false;
    if (key == "approximate") s.approximate = true;
    if (key == "tessellate") s.form = Form::kTessellation;
  } else if (key == "max-depth") {
    need(words, 2, 2, "max-depth N");
    s.max_depth = integer(words[1], 0, 10);
  } else if (key == "buffer") {
    need(words, 3, 3, "buffer BINDING BYTES");
    s.buffers.push_back({integer(words[1], 2, 63), formula(words[2])});
    if (std::any_of(s.buffers.begin(), s.buffers.end() - 1,
                    [&](const ShaderSource::Buffer& b) { return b.binding == s.buffers.back().binding; }))
      refuse("binding " + words[1] + " has two buffers");
  } else if (key == "pass") {
    need(words, 3, 4, "pass NAME ITEMS, or pass NAME ITEMS FIRST..LAST");
    const auto letter = [](char c) { return (c | 32) >= 'a' && (c | 32) <= 'z'; };
    if (!letter(words[1][0]) || words[1].starts_with("lc_") || words[1] == "main" ||
        !std::ranges::all_of(words[1],
                             [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; }))
      refuse("'" + words[1] +
             "' is no name of a pass: a letter, then letters, digits and _; not main or lc_");
    ShaderSource::Pass pass{words[1], formula(words[2]), {}};
    if (words.size() == 4) {
      const std::size_t dots = words[3].find("..");
      if (dots == std::string::npos) refuse("levels are FIRST..LAST, as 0..d-1");
      pass.levels = {formula(words[3].substr(0, dots)), formula(words[3].substr(dots + 2))};
    }
    s.passes.push_back(std::move(pass));
  } else if (key == "output") {
    need(words, 3, 3, "output VERTICES TRIANGLES");
    s.output = {formula(words[1]), formula(words[2])};
  } else {
    refuse(
        fmt::format("there is no pragma '{}'; there are: scheme, sharp, points, weights, boundary, faces, "
                    "no-normals, approximate, max-depth, buffer, pass, output, tessellate",
                    key));
  }
}

}  // namespace

std::array<std::int64_t, 4> MeshCounts::after(std::int64_t steps) const {
  std::array<std::int64_t, 4> now = of;
  for (std::int64_t k = 0; k < steps; ++k) {
    const auto [v, f, c, e] = now;
    if (scheme == LC_SCHEME_LOOP)
      now = {v + e, 4 * f, 12 * f, 2 * e + 3 * f};
    else
      now = {v + e + f, c, 4 * c, 2 * e + c};
  }
  return now;
}

std::int64_t Formula::value(const MeshCounts& counts) const {
  return Parser(text_, counts).whole();
}

lc_scheme ShaderSource::one_scheme() const {
  if (schemes == LC_DOES_LOOP) return LC_SCHEME_LOOP;
  if (schemes == LC_DOES_CATMULL_CLARK) return LC_SCHEME_CATMULL_CLARK;
  refuse(file +
         ": a module of Vulkan does one scheme: write #pragma limitcheck scheme loop, or catmull-clark");
}

ShaderSource read_shader(const std::string& named) {
  ShaderSource source;
  source.file = named;
  source.spirv = named.ends_with(".spv");
  const std::string file = named + (source.spirv ? ".pragmas" : "");
  std::string content;
  try {
    content = data::io::whole_content(file);
  } catch (const data::Error& error) {
    refuse(error.what());
  }
  // Compilers count lines as we do: at CR, LF and CR LF; they take no mark of the byte order and stop at a NUL.
  if (content.starts_with("\xEF\xBB\xBF")) content.erase(0, 3);
  for (std::size_t at = 0; (at = content.find('\r', at)) != std::string::npos;)
    content.replace(at, content.compare(at, 2, "\r\n") == 0 ? 2 : 1, "\n");
  if (const std::size_t nul = content.find('\0'); nul != std::string::npos)
    refuse(fmt::format(
        "{}:{}: a NUL, which no text has", file,
        1 + std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(nul), '\n')));
  std::istringstream lines(content);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    Words words;
    if (line.starts_with("#version")) line = "// " + line;
    try {
      if (pragma(line, words)) take(source, words);
    } catch (const SubjectError& error) {
      refuse(fmt::format("{}:{}: {}", file, number, error.what()));
    }
    source.text += line + "\n";
  }
  using Form = ShaderSource::Form;
  source.own_group = source.text.find("local_size_x") != std::string::npos;
  source.own_control = source.text.find("LC_CONTROL") != std::string::npos;
  if (source.form == Form::kTessellation) {
    source.max_depth = std::min(source.max_depth, 6);
    if (!source.passes.empty()) refuse(file + ": it has the pragmas of two forms: tessellate and pass");
  } else if (!source.passes.empty()) {
    source.form = Form::kPasses;
    if (source.output.empty())
      refuse(file + ": it has passes, and no #pragma limitcheck output VERTICES TRIANGLES");
  } else if (!source.buffers.empty() || !source.output.empty()) {
    refuse(file + ": it has a buffer or an output, and no #pragma limitcheck pass");
  } else if (!source.spirv && source.text.find("lc_evaluate") == std::string::npos) {
    refuse(file +
           ": it has neither a function lc_evaluate nor a #pragma limitcheck pass or tessellate: see "
           "verify/subject/SHADERS.md");
  }
  if (source.spirv) (void)source.one_scheme();
  if (source.spirv && source.form == Form::kTessellation)
    refuse(file + ": tessellation shaders are audited by OpenGL alone, as GLSL");
  return source;
}

}  // namespace limitcheck::verify
