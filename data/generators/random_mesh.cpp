// SPDX-License-Identifier: MIT
#include "data/generators/random_mesh.h"

#include <algorithm>
#include <array>
#include <string>
#include <unordered_map>
#include <vector>

#include "data/building_blocks.h"
#include "data/shapes.h"
#include "data/splitmix64.h"

namespace limitcheck::data {
namespace {

using Index = std::int32_t;

constexpr int kLeastMaxValence = 12;  // what the stock shapes below have

// A mesh that stays a valid manifold under every operation here; what would break it is refused.
class Editor {
 public:
  Editor(const ControlMesh& mesh, std::uint64_t seed, int max_valence)
      : random_(seed),
        positions_(mesh.positions),
        neighbour_(positions_.size(), -1),
        max_valence_(max_valence) {
    for (const auto& t : triangles_of(mesh)) add(t[0], t[1], t[2]);
  }

  int face_count() const { return static_cast<int>(faces_.size()); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_.next() % n); }

  // An edge of a random face, and what lies about it: faces a b c and, unless the edge is a border, b a d.
  struct Edge {
    Index a, b, c, d;
    bool border() const { return d < 0; }
  };
  Edge pick() {
    const auto& f = faces_[below(faces_.size())];
    const std::size_t k = below(3);
    return edge(f[k], f[(k + 1) % 3]);
  }

  bool split_edge(const Edge& e) {
    if (full(e.c) || (!e.border() && full(e.d))) return false;
    const Index m = new_vertex({e.a, e.b});
    remove(e.a, e.b);
    add(e.a, m, e.c), add(m, e.b, e.c);
    if (e.border()) return true;
    remove(e.b, e.a);
    add(e.b, m, e.d), add(m, e.a, e.d);
    return true;
  }

  bool split_face(const Edge& e) {
    if (full(e.a) || full(e.b) || full(e.c)) return false;
    const Index m = new_vertex({e.a, e.b, e.c});
    remove(e.a, e.b);
    add(e.a, e.b, m), add(e.b, e.c, m), add(e.c, e.a, m);
    return true;
  }

  bool flip(const Edge& e) {
    if (e.border() || joined(e.c, e.d) || full(e.c) || full(e.d)) return false;
    if (!can_lose_a_face(e.a) || !can_lose_a_face(e.b)) return false;
    remove(e.a, e.b), remove(e.b, e.a);
    add(e.c, e.a, e.d), add(e.d, e.b, e.c);
    return true;
  }

  // b goes into a. The two must have no common neighbour but those across the edge (the link condition).
  bool collapse(const Edge& e) {
    const Ring ra = ring(e.a), rb = ring(e.b);
    if (!e.border() && !ra.closed && !rb.closed) return false;
    int common = 0;
    for (const Index v : ra.neighbours)
      common += std::count(rb.neighbours.begin(), rb.neighbours.end(), v) > 0;
    if (common != (e.border() ? 1 : 2)) return false;
    if (!can_lose_a_face(e.c) || (!e.border() && !can_lose_a_face(e.d))) return false;
    const int valence = static_cast<int>(ra.neighbours.size() + rb.neighbours.size()) - 2 - common;
    if (valence < 3 && ra.closed && rb.closed) return false;
    if (valence < 2 || valence > max_valence_) return false;
    std::vector<Face> moved;
    for (std::size_t k = 0; k + (rb.closed ? 0 : 1) < rb.neighbours.size(); ++k) {
      const Index r = rb.neighbours[k], next = rb.neighbours[(k + 1) % rb.neighbours.size()];
      remove(e.b, r);
      if (r != e.a && next != e.a) moved.push_back({e.a, r, next});
    }
    for (const Face& f : moved) add(f[0], f[1], f[2]);
    return true;
  }

  // A hole, or a bay in the border: the face must leave neither a bow-tie nor a vertex without faces.
  bool cut_out(const Edge& e) {
    if (!ring(e.c).closed) return false;
    if (!e.border() && (!ring(e.a).closed || !ring(e.b).closed)) return false;
    remove(e.a, e.b);
    return true;
  }

  bool add_ear(const Edge& e) {
    if (!e.border() || full(e.a) || full(e.b)) return false;
    add(e.b, e.a, new_vertex({e.a, e.b}));
    return true;
  }

  // The corner at b between two border edges, closed by a face.
  bool fill_corner(const Edge& e) {
    if (!e.border()) return false;
    const Ring r = ring(e.b);  // from the next vertex of the border to a
    const Index next = r.neighbours.front();
    if (r.neighbours.size() < 3 || joined(e.a, next) || full(e.a) || full(next)) return false;
    add(e.b, e.a, next);
    return true;
  }

  // Edges across from v are flipped towards it.
  void collect_neighbours(Index v, int valence) {
    for (int attempts = 4 * valence; attempts > 0; --attempts) {
      const Ring r = ring(v);
      if (static_cast<int>(r.neighbours.size()) >= valence) return;
      const std::size_t k = below(r.neighbours.size());
      const Index a = r.neighbours[k], b = r.neighbours[(k + 1) % r.neighbours.size()];
      if (face_of(a, b) >= 0) flip(edge(a, b));
    }
  }

  Index pick_vertex() {
    const Face& f = faces_[below(faces_.size())];
    return f[below(3)];
  }

  ControlMesh result() {
    smooth();
    ControlMesh mesh;
    std::vector<Index> number(positions_.size(), -1);
    for (const Face& f : faces_) {
      for (const Index v : f) number[v] = 0;
    }
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] < 0) continue;
      number[v] = static_cast<Index>(mesh.positions.size());
      mesh.positions.push_back(positions_[v]);
    }
    for (const Face& f : faces_) mesh.faces.push_back({number[f[0]], number[f[1]], number[f[2]]});
    return mesh;
  }

 private:
  using Face = std::array<Index, 3>;
  struct Ring {
    std::vector<Index> neighbours;  // counter-clockwise; if open, along the border first
    bool closed;
  };

  static std::uint64_t key(Index a, Index b) {
    return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
  }

  void add(Index a, Index b, Index c) {
    const auto f = static_cast<Index>(faces_.size());
    faces_.push_back({a, b, c});
    face_[key(a, b)] = face_[key(b, c)] = face_[key(c, a)] = f;
    neighbour_of(a) = b, neighbour_of(b) = c, neighbour_of(c) = a;
  }

  // The face on the left of a -> b.
  void remove(Index a, Index b) {
    const Index f = face_.at(key(a, b));
    const Face old = faces_[f];
    for (std::size_t k = 0; k < 3; ++k) face_.erase(key(old[k], old[(k + 1) % 3]));
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = old[k], after = old[(k + 1) % 3], before = old[(k + 2) % 3];
      neighbour_of(v) = face_of(v, before) >= 0 ? before : across(after, v);
    }
    const Face last = faces_.back();
    faces_.pop_back();
    if (f == static_cast<Index>(faces_.size())) return;
    faces_[f] = last;
    for (std::size_t k = 0; k < 3; ++k) face_[key(last[k], last[(k + 1) % 3])] = f;
  }

  Index face_of(Index a, Index b) const {
    const auto at = face_.find(key(a, b));
    return at == face_.end() ? -1 : at->second;
  }
  bool joined(Index a, Index b) const { return face_of(a, b) >= 0 || face_of(b, a) >= 0; }
  // The third vertex of the face on the left of a -> b, or -1.
  Index across(Index a, Index b) const {
    const Index f = face_of(a, b);
    if (f < 0) return -1;
    const Face& t = faces_[f];
    return t[0] == a ? t[2] : t[1] == a ? t[0] : t[1];
  }
  Edge edge(Index a, Index b) const { return {a, b, across(a, b), across(b, a)}; }

  // v -> this one has a face on its left; -1 or a former neighbour if the faces about v came and went.
  Index& neighbour_of(Index v) { return neighbour_[v]; }
  Index search_neighbour(Index v) const {
    for (const Face& f : faces_) {
      for (std::size_t k = 0; k < 3; ++k)
        if (f[k] == v) return f[(k + 1) % 3];
    }
    return -1;
  }

  Ring ring(Index v) {
    Index first = neighbour_of(v);
    if (first < 0 || face_of(v, first) < 0) first = neighbour_of(v) = search_neighbour(v);
    Ring r{{}, true};
    for (Index at = first;;) {  // clockwise to the border, if there is one
      const Index before = across(at, v);
      if (before < 0) {
        r.closed = false;
        first = at;
        break;
      }
      at = before;
      if (at == first) break;
    }
    for (Index at = first; at >= 0;) {
      r.neighbours.push_back(at);
      at = across(v, at);
      if (at == first) break;
    }
    return r;
  }

  bool full(Index v) { return static_cast<int>(ring(v).neighbours.size()) >= max_valence_; }
  bool can_lose_a_face(Index v) {
    const Ring r = ring(v);
    return r.neighbours.size() > (r.closed ? 3 : 2);
  }

  // Amid the given ones, and off by up to a third of the first edge.
  Index new_vertex(const std::vector<Index>& amid) {
    std::array<double, 3> p{};
    for (std::size_t c = 0; c < 3; ++c) {
      double low = 1e30, high = -1e30;
      for (const Index v : amid) {
        const double x = positions_[v][c];
        p[c] += x / static_cast<double>(amid.size());
        low = std::min(low, x), high = std::max(high, x);
      }
      p[c] += (high - low + .01) * (random_.unit() - .5) * .6;
    }
    positions_.push_back(p);
    neighbour_.push_back(-1);
    return static_cast<Index>(positions_.size() - 1);
  }

  void smooth() {
    auto smoothed = positions_;
    std::vector<std::array<double, 4>> sum(positions_.size());
    for (const Face& f : faces_) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& next = positions_[f[(k + 1) % 3]];
        auto& s = sum[f[k]];
        for (std::size_t c = 0; c < 3; ++c) s[c] += next[c];
        s[3] += 1;
      }
    }
    for (std::size_t v = 0; v < smoothed.size(); ++v) {
      if (sum[v][3] == 0) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const double mean = sum[v][c] / sum[v][3], here = smoothed[v][c];
        const double shake = (random_.unit() - .5) * .1 * (mean - here);
        smoothed[v][c] = static_cast<double>(static_cast<float>((here + mean) / 2 + shake));
      }
    }
    positions_ = smoothed;
  }

  SplitMix64 random_;
  std::vector<std::array<double, 3>> positions_;
  std::vector<Face> faces_;
  std::unordered_map<std::uint64_t, Index> face_;  // of each directed edge
  std::vector<Index> neighbour_;                   // of each vertex
  int max_valence_;
};

// The closed ones come first.
constexpr std::array<ControlMesh (*)(), 16> kStart{
    [] { return tetrahedron(); }, [] { return octahedron(); },  [] { return icosahedron(); },
    [] { return cube(); },        [] { return torus(6, 4); },   [] { return torus(3, 3); },
    [] { return bipyramid(5); },  [] { return bipyramid(12); }, [] { return two_components(); },
    [] { return wheel(7, 2); },   [] { return fan(4, 1); },     [] { return sheet(3, 3); },
    [] { return holes(); },       [] { return strip(6); },      [] { return ragged_disc(); },
    [] { return triangle(); }};
constexpr std::size_t kClosed = 8;

}  // namespace

ControlMesh random_mesh(std::uint64_t seed, const RandomMeshOptions& options) {
  require(options.faces >= 1 && options.faces <= 1'000'000,
          "a random mesh has 1 to 1000000 faces, not " + std::to_string(options.faces));
  require(options.max_valence >= kLeastMaxValence,
          "a random mesh has a largest valence of 12 or more, not " + std::to_string(options.max_valence));

  SplitMix64 random(seed);
  const std::uint64_t choice = random.next();
  const bool closed = choice % 2 == 0;  // starts closed and stays so
  const std::size_t start = random.next() % (closed ? kClosed : kStart.size());
  Editor editor(kStart[start](), random.next(), options.max_valence);

  const int hubs = static_cast<int>(random.next() % 4);
  const auto change = [&] {
    const Editor::Edge e = editor.pick();
    const std::size_t what = editor.below(16);
    const bool grow = editor.face_count() < options.faces;
    if (what < 6) {
      editor.flip(e);
    } else if (!closed && what < 10) {
      what == 6 ? editor.cut_out(e) : what == 7 ? editor.fill_corner(e) : grow&& editor.add_ear(e);
    } else if (grow) {
      what < 14 ? editor.split_edge(e) : what == 14 ? editor.split_face(e) : editor.collapse(e);
    } else {
      editor.collapse(e);
    }
  };
  const auto reached = [&] {
    return editor.face_count() >= options.faces && editor.face_count() <= options.faces + 2;
  };
  // Meshes of few faces may not allow another collapse; hence the limit.
  for (int left = 100 + 20 * options.faces; left > 0 && !reached(); --left) change();
  for (int left = editor.face_count() / 2; left > 0; --left) editor.flip(editor.pick());
  for (int k = 0; k < hubs; ++k) {
    const auto most = static_cast<std::size_t>(options.max_valence - 6);
    const int valence = 7 + static_cast<int>(editor.below(most));
    editor.collect_neighbours(editor.pick_vertex(), valence);
  }
  return editor.result();
}

}  // namespace limitcheck::data
