// SPDX-License-Identifier: MIT
#include "data/generators/star_meshes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "data/building_blocks.h"
#include "data/generators/awkward_meshes.h"
#include "data/sharpness_classes.h"
#include "data/splitmix64.h"

namespace limitcheck::data {
namespace {

constexpr std::size_t kMostFacesOfStars = 1'000'000;

// Reads a text from its beginning.
class Text {
 public:
  explicit Text(std::string_view text) : left_(text) {}

  bool empty() const { return left_.empty(); }
  bool take(char c) {
    if (!left_.starts_with(c)) return false;
    left_.remove_prefix(1);
    return true;
  }
  char letter() {
    require(!left_.empty() && sharpness_of(left_[0]) >= 0,
            "\"" + std::string(left_.substr(0, 1)) + "\" is no letter of a sharpness");
    const char c = left_[0];
    left_.remove_prefix(1);
    return c;
  }
  bool has_number() const {
    return !left_.empty() && std::isdigit(static_cast<unsigned char>(left_[0])) != 0;
  }
  std::uint64_t number(std::uint64_t most) {
    std::uint64_t value = 0;
    const auto [stop, error] = std::from_chars(left_.data(), left_.data() + left_.size(), value);
    require(error == std::errc() && value <= most, "a number up to " + std::to_string(most) + " is missing");
    left_.remove_prefix(static_cast<std::size_t>(stop - left_.data()));
    return value;
  }

 private:
  std::string_view left_;
};

Star parse_star(std::string_view text) {
  Text in(text);
  Star star;
  star.open = in.take('o');
  star.bare = in.take('r');
  if (in.take('v')) star.own = in.letter();
  if (in.take('w')) star.beyond = in.take('=') ? '=' : in.letter();
  if (in.take('z')) star.aside = in.letter();
  if (in.take('y')) star.across = in.letter();
  while (!in.empty()) {
    if (in.has_number() && !star.spokes.empty()) {
      star.spokes.append(std::max<std::uint64_t>(in.number(100'000), 1) - 1, star.spokes.back());
    } else if (!in.take('/')) {
      star.spokes += in.letter();
    } else {
      do star.corners.push_back(static_cast<int>(in.number(100'000)));
      while (in.take('-'));
      require(in.empty(), "behind the corners of a star there is something else");
    }
  }
  return star;
}

// Puts stars into a mesh, one after the other.
class Builder {
 public:
  Builder(ControlMesh& mesh, bool triangles, std::uint64_t seed)
      : mesh_(mesh), triangles_(triangles), random_(seed) {}

  void add(const Star& star, double height) {
    const std::size_t spokes = star.spokes.size(), faces = star.faces();
    require(star.spokes.size() >= (star.open ? 2U : 3U), "a star has 3 spokes and more, on a boundary 2");
    const double whole =
        2 * std::numbers::pi * (star.open ? std::min(0.9, 0.22 * static_cast<double>(faces)) : 1);
    turn_ = whole / static_cast<double>(faces);
    for (double& x : bend_) x = 0.3 * varied(1);
    height_ = height;
    const std::int32_t centre = point(0, 0);
    std::vector<std::int32_t> end(spokes), far(spokes, -1), before(spokes, -1), after(spokes, -1);
    for (std::size_t i = 0; i < spokes; ++i) end[i] = point(1, angle(i, 0));
    if (!star.bare)
      for (std::size_t i = 0; i < spokes; ++i) far[i] = point(2, angle(i, 0));

    for (std::size_t i = 0; i < faces; ++i) {
      const std::size_t next = (i + 1) % spokes;
      const int corners = i < star.corners.size() ? star.corners[i] : triangles_ ? 3 : 4;
      require(corners >= 3 && (!triangles_ || corners == 3),
              "a star has a face of no such number of corners");
      const std::vector<std::int32_t> outline = sides(i, end[i], end[next], corners - 3);
      std::vector<std::int32_t> face{centre};
      face.insert(face.end(), outline.begin(), outline.end());
      mesh_.faces.push_back(face);
      after[i] = outline[1], before[next] = outline[outline.size() - 2];
      if (!star.bare) surround(i, outline, far[i], far[next]);
    }
    tag(star, centre, end, {far, before, after});
  }
  /// The second rings.
  void finish() {
    for (const auto& face : outer_) mesh_.faces.push_back(face);
    outer_.clear();
    require(mesh_.faces.size() <= kMostFacesOfStars, "the stars have more than a million faces");
  }

 private:
  double varied(double amplitude) { return amplitude * (2 * random_.unit() - 1); }
  double angle(std::size_t sector, double part) const { return turn_ * (static_cast<double>(sector) + part); }

  // Near (radius, angle) on a bent sheet; neighbours on a ring are far enough apart.
  std::int32_t point(double radius, double at, double apart = 1) {
    const double amplitude = std::min(0.2, 0.25 * turn_ * apart);
    const double x = radius * std::cos(at) + varied(amplitude), y = radius * std::sin(at) + varied(amplitude);
    const double z = height_ + bend_[0] * x * x + bend_[1] * x * y + bend_[2] * y * y + varied(amplitude);
    mesh_.positions.push_back({rounded(x), rounded(y), rounded(z)});
    return static_cast<std::int32_t>(mesh_.positions.size() - 1);
  }

  // From the end of one spoke to that of the next, with so many points between.
  std::vector<std::int32_t> sides(std::size_t sector, std::int32_t from, std::int32_t to, int between) {
    std::vector<std::int32_t> list{from};
    const double apart = 1.0 / (between + 1);
    for (int j = 1; j <= between; ++j) list.push_back(point(1.4, angle(sector, j * apart), apart));
    list.push_back(to);
    return list;
  }

  // Faces beyond the outline of a sector, so that its vertices are regular. From the spokes' ends one edge goes
  // outward, from what is between them two.
  void surround(std::size_t sector, const std::vector<std::int32_t>& outline, std::int32_t from,
                std::int32_t to) {
    if (triangles_) {
      const std::int32_t middle = point(1.8, angle(sector, 0.5), 0.5);
      outer_.push_back({outline[0], from, middle});
      outer_.push_back({outline[0], middle, outline[1]});
      outer_.push_back({outline[1], middle, to});
      return;
    }
    const double apart = 1.0 / static_cast<double>(outline.size() - 1);
    std::int32_t before = from;
    for (std::size_t j = 1; j < outline.size(); ++j) {
      const bool last = j + 1 == outline.size();
      const double at = static_cast<double>(j) * apart;
      const std::int32_t after = last ? to : point(2.1, angle(sector, at - apart / 3), apart / 3);
      outer_.push_back({outline[j - 1], before, after, outline[j]});
      if (last) break;
      const std::int32_t tip = point(2.4, angle(sector, at), apart / 3);
      before = point(2.1, angle(sector, at + apart / 3), apart / 3);
      outer_.push_back({outline[j], after, tip, before});
    }
  }

  // What the ends of spokes are joined to, beside the centre.
  struct Around {
    std::vector<std::int32_t> far, before, after;
  };
  void tag(const Star& star, std::int32_t centre, const std::vector<std::int32_t>& end,
           const Around& around) {
    Sharpness& sharp = mesh_.sharpness;
    const auto edge = [&](std::int32_t a, std::int32_t b, char letter) {
      if (letter != '.' && b >= 0) sharp.edges.push_back({a, b, sharpness_of(letter)});
    };
    bool aside = true;
    for (std::size_t i = 0; i < star.spokes.size(); ++i) {
      const bool border = star.open && (i == 0 || i + 1 == star.spokes.size());
      edge(centre, end[i], star.spokes[i]);
      if (star.spokes[i] != '.')
        edge(end[i], around.far[i], star.beyond == '=' ? star.spokes[i] : star.beyond);
      if (star.spokes[i] != '.' || border || !aside) continue;
      edge(end[i], around.far[i], star.aside);
      edge(end[i], around.before[i], star.across), edge(end[i], around.after[i], star.across);
      aside = false;
    }
    if (star.own != '.') sharp.vertices.push_back({centre, sharpness_of(star.own)});
  }

  ControlMesh& mesh_;
  bool triangles_;
  SplitMix64 random_;
  double turn_ = 0, height_ = 0;
  std::array<double, 3> bend_{};
  std::vector<std::vector<std::int32_t>> outer_;
};

// Tetrahedra or cubes until there are so many vertices.
void fill(ControlMesh& mesh, std::size_t vertices, bool triangles) {
  if (mesh.positions.size() >= vertices) return;
  const std::size_t first = mesh.positions.size(), each = triangles ? 4 : 8;
  append(mesh, crowd(static_cast<int>((vertices - first + each - 1) / each), !triangles),
         {0, 0, 64 * static_cast<double>(vertices / 0x8000)});  // above those before
}

}  // namespace

std::string Star::text() const {
  std::string out = std::string(open ? "o" : "") + (bare ? "r" : "");
  for (const auto& [word, letter] :
       {std::pair{'v', own}, std::pair{'w', beyond}, std::pair{'z', aside}, std::pair{'y', across}})
    if (letter != '.') out += {word, letter};
  for (std::size_t i = 0; i < spokes.size();) {
    std::size_t same = i;
    while (same < spokes.size() && spokes[same] == spokes[i]) ++same;
    out += same - i > 2 ? spokes[i] + std::to_string(same - i) : spokes.substr(i, same - i);
    i = same;
  }
  for (std::size_t i = 0; i < corners.size(); ++i) out += (i == 0 ? "/" : "-") + std::to_string(corners[i]);
  return out;
}

std::string Stars::text() const {
  std::string out = std::to_string(seed) + (chaikin ? "c" : "") + (corners_held ? "h" : "") +
                    (smooth_triangles ? "s" : "") + (thrice ? "t" : "");
  for (std::size_t k = 0; k < stars.size(); ++k) out += (k == 0 ? ":" : "_") + stars[k].text();
  return out;
}

Stars parse_stars(const std::string& text) {
  const std::size_t colon = text.find(':');
  require(colon != std::string::npos, "a seed and a star are needed, as in star:1:J.J.3");
  Text in(std::string_view(text).substr(0, colon));
  Stars stars;
  stars.seed = in.number(~std::uint64_t{0});
  stars.chaikin = in.take('c');
  stars.corners_held = in.take('h');
  stars.smooth_triangles = in.take('s');
  stars.thrice = in.take('t');
  require(in.empty(), "behind the seed there are c, h, s and t at most");
  for (std::size_t begin = colon + 1; begin <= text.size();) {
    const std::size_t stop = std::min(text.find('_', begin), text.size());
    stars.stars.push_back(parse_star(std::string_view(text).substr(begin, stop - begin)));
    begin = stop + 1;
  }
  return stars;
}

ControlMesh star_mesh(const Stars& stars, bool triangles) {
  ControlMesh mesh;
  mesh.sharpness.creasing = stars.chaikin ? Creasing::kChaikin : Creasing::kUniform;
  mesh.sharpness.boundary = stars.corners_held ? Boundary::kEdgeAndCorner : Boundary::kEdge;
  mesh.sharpness.triangles = stars.smooth_triangles ? TriangleRule::kSmooth : TriangleRule::kCatmark;
  Builder builder(mesh, triangles, stars.seed);
  for (const std::size_t from : {0U, 0x8000U, 0x10000U}) {
    if (from > 0 && !stars.thrice) break;
    fill(mesh, from, triangles);
    for (std::size_t k = 0; k < stars.stars.size(); ++k) builder.add(stars.stars[k], static_cast<double>(k));
    builder.finish();
  }
  return mesh;
}

const std::vector<PlannedStars>& planned_stars(bool triangles) {
#include "data/generators/planned_stars.inc"
  return triangles ? loop : quads;
}

}  // namespace limitcheck::data
