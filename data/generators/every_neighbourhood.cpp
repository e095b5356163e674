// SPDX-License-Identifier: MIT
#include "data/generators/every_neighbourhood.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <tuple>

#include "data/sharpness_classes.h"

namespace limitcheck::data {
namespace {

constexpr std::size_t kTogether = 48;  // neighbourhoods in a mesh
constexpr char kPart = 'b', kLonger = 'e', kEver = 'J';

// The tags of the edges of a vertex, and the corners of the face behind each; on a boundary the first and the
// last edge are without tags, and there is a face less.
struct Layout {
  std::string edges, faces;
  friend auto operator<=>(const Layout&, const Layout&) = default;
};

Layout mirrored(Layout at, bool closed) {
  std::reverse(at.edges.begin(), at.edges.end());
  std::reverse(at.faces.begin(), at.faces.end());
  if (closed) std::rotate(at.edges.begin(), at.edges.end() - 1, at.edges.end());  // face k is behind edge k
  return at;
}

// Whether it is the first of all that rotations and the mirror make of it.
bool is_first(const Layout& at, bool closed) {
  Layout image = at;
  for (std::size_t k = 0; k < (closed ? at.edges.size() : 1); ++k) {
    if (image < at || mirrored(image, closed) < at) return false;
    std::rotate(image.edges.begin(), image.edges.begin() + 1, image.edges.end());
    std::rotate(image.faces.begin(), image.faces.begin() + 1, image.faces.end());
  }
  return true;
}

// Calls `with` with each word of so many letters.
template <class With>
void each_word(std::size_t length, std::string_view letters, const With& with) {
  std::string word(length, letters[0]);
  std::vector<std::size_t> digit(length);
  for (;;) {
    with(word);
    std::size_t k = 0;
    while (k < length && digit[k] + 1 == letters.size()) word[k] = letters[digit[k] = 0], ++k;
    if (k == length) return;
    word[k] = letters[++digit[k]];
  }
}

class Enumeration {
 public:
  Enumeration(bool triangles, std::int32_t kinds) : triangles_(triangles), kinds_(kinds) {}

  void add(bool closed, std::size_t faces) {
    closed_ = closed, faces_ = faces;
    const std::string quads(faces, '4');
    tagged(".beJ", ".", quads);
    tagged(".eJ", "beJ", quads);
    for (std::size_t k = 0; k < kFirstInfiniteClass; ++k) {
      const char c = kSharpnessClasses[k].letter;
      if (c != kPart && c != kLonger) tagged({'.', c}, {'.', c}, quads, c);
    }
    if (triangles_) return;
    const std::string smooth(edges(), '.');
    each_word(faces, "345", [&](const std::string& corners) {
      if (corners != quads) keep({smooth, corners}, '.');
    });
    for (const char c : {'6', '7', '8'})
      each_word(faces, std::string{'4', c}, [&](const std::string& corners) {
        if (corners != quads) keep({smooth, corners}, '.');
      });
    for (const char c : {'3', '5', '6', '7', '8'})
      for (std::size_t f = 0; f < faces; ++f) {
        std::string corners = quads;
        corners[f] = c;
        for (const char tag : {kPart, kLonger, kEver}) tagged({'.', tag}, ".", corners, tag);
      }
  }

  std::vector<Stars> meshes() const {
    std::vector<Stars> list;
    for (const auto& [choices, stars] : stars_)
      for (std::size_t k = 0; k < stars.size(); ++k) {
        if (k % kTogether == 0) {
          Stars& mesh = list.emplace_back();
          mesh.seed = list.size();
          std::tie(mesh.chaikin, mesh.corners_held, mesh.smooth_triangles) = choices;
        }
        list.back().stars.push_back(stars[k]);
      }
    return list;
  }

 private:
  using Choices = std::tuple<bool, bool, bool>;  // Chaikin's creasing, corners held, smooth triangles

  std::size_t edges() const { return closed_ ? faces_ : faces_ + 1; }
  bool can(std::int32_t kinds) const { return (kinds_ & kinds) == kinds; }
  bool can_have(char tag) const { return tag == '.' || can(tag == kEver ? kWithCreases : kWithSemiSharp); }
  std::string those_it_can(std::string letters) const {
    std::erase_if(letters, [&](char c) { return !can_have(c); });
    return letters;
  }

  // All tags of these letters, amid such faces; only those that have one letter, if it is given.
  void tagged(const std::string& letters, const std::string& own, const std::string& corners,
              char needed = 0) {
    const std::string some = those_it_can(letters);
    for (const char at_vertex : those_it_can(own)) {
      if (at_vertex != '.' && !can(kWithCorners)) continue;
      each_word(closed_ ? faces_ : faces_ - 1, some, [&](const std::string& word) {
        if (needed != 0 && at_vertex != needed && word.find(needed) == std::string::npos) return;
        keep({closed_ ? word : "." + word + ".", corners}, at_vertex);
      });
    }
  }

  void keep(const Layout& at, char own) {
    if (!is_first(at, closed_)) return;
    if (can(kWithoutDarts) && closed_ && std::count(at.edges.begin(), at.edges.end(), kEver) == 1) return;
    Star star;
    star.spokes = at.edges;
    star.open = !closed_;
    star.own = own;
    const bool sharp = at.edges.find_first_not_of('.') != std::string::npos;
    const bool semi_sharp = at.edges.find_first_not_of(std::string{'.', kEver}) != std::string::npos;
    if (sharp) star.beyond = '=';
    if (at.faces.find_first_not_of('4') != std::string::npos)
      for (const char c : at.faces) star.corners.push_back(c - '0');
    for (const bool chaikin : {false, true})
      for (const bool held : {false, true})
        for (const bool smooth : {false, true})
          if ((!chaikin || (can(kWithChaikin) && semi_sharp)) &&
              (!held || (can(kWithCorners) && !closed_ && faces_ == 1)) &&
              (!smooth || (can(kWithSmoothTriangles) && at.faces.find('3') != std::string::npos)))
            stars_[{chaikin, held, smooth}].push_back(star);
  }

  bool triangles_, closed_ = true;
  std::int32_t kinds_;
  std::size_t faces_ = 0;
  std::map<Choices, std::vector<Star>> stars_;
};

}  // namespace

const std::vector<Stars>& every_neighbourhood(bool triangles, int most, std::int32_t kinds) {
  static std::map<std::tuple<bool, int, std::int32_t>, std::vector<Stars>> kept;
  const auto [at, is_new] = kept.try_emplace({triangles, most, kinds});
  if (is_new) {
    Enumeration all(triangles, kinds);
    for (std::size_t n = 3; n <= static_cast<std::size_t>(most); ++n) all.add(true, n);
    for (std::size_t n = 1; n <= static_cast<std::size_t>(most); ++n) all.add(false, n);
    at->second = all.meshes();
  }
  return at->second;
}

std::string neighbourhoods_name(bool triangles, int most, std::int32_t kinds) {
  return std::string(triangles ? "" : "quad-") + "neighbourhoods:" + std::to_string(most) + ":" +
         std::to_string(kinds) + ":";
}

const Star& star_of_face(const Stars& stars, const ControlMesh& mesh, std::size_t face) {
  // The vertices of a star are numbered in one, its centre first.
  const auto corners = mesh.faces[face];
  const std::int32_t v = *std::min_element(corners.begin(), corners.end());
  std::size_t first = 0, k = 0;
  while (k + 1 < stars.stars.size() && mesh.faces[first + stars.stars[k].faces()][0] <= v)
    first += stars.stars[k++].faces();
  return stars.stars[k];
}

}  // namespace limitcheck::data
