// SPDX-License-Identifier: MIT
#include "verify/mutants/quad_models/quad_kernel_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "fast/rules/prepared_quads.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::verify {

namespace {

using Point = QuadKernelModel::Point;
using Vertex = QuadKernelModel::Vertex;
using Star = fast::OwnQuadStar<double>;
using Surface = fast::LimitSurface<double>;

constexpr int kCornerI[] = {0, 1, 1, 0}, kCornerJ[] = {0, 0, 1, 1};

}  // namespace

/// One quad from level to level.
class QuadKernelModel::Lattice {
 public:
  Lattice(const QuadKernelModel& model, std::int32_t quad)
      : model_(model), mesh_(model.mesh_), quad_(quad), points_(16) {
    for (int k = 0; k < 4; ++k) {
      const std::int32_t h = 4 * quad + k;
      sharp_[k] = mesh_.adjacency.twin(h) < 0;
      gather(k, is("stale_lane") && k == 3 && quad % 4 == 3 ? h - 4 : h);
      limits_[k] = corner_limit(k);
      at(kCornerI[k], kCornerJ[k]) = stars_[k].star.centre;
    }
    put_beyond();
    if (is("polynomial_at_valence_5")) {
      for (int k = 0; k < 4; ++k)
        if (!stars_[k].star.open)
          at(3 * kCornerI[k] - 1, 3 * kCornerJ[k] - 1) = stars_[k].star.face(sector_[k] + 2);
      control_ = points_;
    }
  }

  /// last: to the deepest level that is displayed.
  void refine(bool last) {
    const int n = size_;
    const std::vector<Point> old = points_;
    const auto p = [&](int i, int j) -> const Point& { return old[index(i, j, n)]; };
    size_ = 2 * n;
    points_.assign(static_cast<std::size_t>((size_ + 3) * (size_ + 3)), Point{});
    const auto face = [&](int i, int j) {
      const Point &a = p(i, j), &b = p(i + 1, j), &c = p(i + 1, j + 1), &d = p(i, j + 1);
      return is("neighbours_first") ? .25 * ((a + b) + (c + d)) : fast::quad_face_point(a, b, c, d);
    };
    // Whether a column or row of the new level is a side with nothing beyond.
    const auto ends = [&](int k, int side_low, int side_high) {
      return (k == 0 && sharp_[side_low]) || (k == size_ && sharp_[side_high]);
    };
    const auto missing = [&](int k, int low, int high) {
      return (k < 0 && sharp_[low]) || (k > size_ && sharp_[high]);
    };
    for (int j = -1; j <= size_ + 1; ++j) {
      for (int i = -1; i <= size_ + 1; ++i) {
        if (missing(i, 3, 1) || missing(j, 0, 2)) continue;
        const bool outside_i = i < 0 || i > size_, outside_j = j < 0 || j > size_;
        if ((outside_i && (outside_j || j == 0 || j == size_)) || (outside_j && (i == 0 || i == size_)))
          continue;
        const int a = i < 0 ? -1 : i / 2, b = j < 0 ? -1 : j / 2;
        Point& to = at(i, j);
        const bool odd_i = i % 2 != 0, odd_j = j % 2 != 0;
        if (odd_i && odd_j) {
          to = face(a, b);
        } else if (odd_i) {
          to = ends(j, 0, 2) ? fast::midpoint(p(a, b), p(a + 1, b))
                             : edge(p(a, b), p(a + 1, b), face(a, b), face(a, b - 1), outside_i || outside_j);
        } else if (odd_j) {
          to = ends(i, 3, 1) ? fast::midpoint(p(a, b), p(a, b + 1))
                             : edge(p(a, b), p(a, b + 1), face(a, b), face(a - 1, b), outside_i || outside_j);
        } else if ((i == 0 || i == size_) && (j == 0 || j == size_)) {
          continue;  // a corner
        } else if (ends(i, 3, 1)) {
          const int in = i == 0 ? 1 : n - 1;
          to = curve(p(a, b), p(a, b + 1), p(a, b - 1), {p(in, b), p(in, b + 1), p(in, b - 1)});
        } else if (ends(j, 0, 2)) {
          const int in = j == 0 ? 1 : n - 1;
          to = curve(p(a, b), p(a + 1, b), p(a - 1, b), {p(a, in), p(a + 1, in), p(a - 1, in)});
        } else if (is("rows_then_columns") && (i == 0 || j == 0 || i == size_ || j == size_)) {
          const auto along = [&](int row) {
            return .125 * ((p(a - 1, row) + p(a + 1, row)) + 6. * p(a, row));
          };
          to = .125 * ((along(b - 1) + along(b + 1)) + 6. * along(b));
        } else {
          const Point f0 = face(a, b), f1 = face(a - 1, b), f2 = face(a - 1, b - 1), f3 = face(a, b - 1);
          to = fast::regular_quad_vertex(
              p(a, b), fast::QuadNeighbours<double>{p(a + 1, b), f0, p(a, b + 1), f1, p(a - 1, b), f2,
                                                    p(a, b - 1), f3});
        }
      }
    }
    for (int k = 0; k < 4; ++k) {
      if (!(last && is("corner_one_level_short"))) subdivide(k);
      at(kCornerI[k] * size_, kCornerJ[k] * size_) = stars_[k].star.centre;
    }
    put_beyond();
    if (last && is("window_one_entry_short") && !sharp_[3]) at(-1, 0) = at(0, 0);
    if (last && is("row_of_another_slot") && size_ >= 4)
      for (int i = 1; i < size_; ++i) at(i, 3) = at(i, size_ >= 8 ? 7 : 1);
  }

  /// Point (i, j), in the quad's own order.
  Vertex limit(int i, int j) {
    const int n = size_;
    const int corner =
        (i == 0 || i == n) && (j == 0 || j == n) ? (j == 0 ? (i == 0 ? 0 : 1) : (i == 0 ? 3 : 2)) : -1;
    if (corner >= 0) return limits_[corner];
    const auto p = [&](int di, int dj) -> const Point& { return at(i + di, j + dj); };
    const auto boundary = [&](int side) {
      // Along the side, so that the quad is to the left.
      static constexpr int kAlong[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
      const int x = kAlong[side][0], y = kAlong[side][1];
      return fast::quad_boundary_limit<double, Surface>(p(0, 0), p(x, y), p(x - y, y + x), p(-y, x),
                                                        p(-x - y, x - y), p(-x, -y), zero_normals_);
    };
    const int side = j == 0 ? 0 : i == n ? 1 : j == n ? 2 : i == 0 ? 3 : -1;
    if (side >= 0 && sharp_[side]) return boundary(side);
    if (is("polynomial_at_valence_5") && side >= 0 && irregular(side)) return polynomial(side, i, j);
    const fast::QuadNeighbours<double> ring{p(1, 0),  p(1, 1),   p(0, 1),  p(-1, 1),
                                            p(-1, 0), p(-1, -1), p(0, -1), p(1, -1)};
    if (is("fused_normals")) {
      const fast::LimitFrame<double> f = fast::regular_quad_limit(p(0, 0), ring);
      const auto fused = [](double a, double b, double c, double d) { return std::fma(a, b, -(c * d)); };
      const Point normal{fused(f.du.y, f.dv.z, f.du.z, f.dv.y), fused(f.du.z, f.dv.x, f.du.x, f.dv.z),
                         fused(f.du.x, f.dv.y, f.du.y, f.dv.x)};
      const double length = std::sqrt(fast::dot(normal, normal));
      if (length > 0) return {f.position, (1 / length) * normal};
    }
    return fast::quad_vertex_limit<double, Surface>(p(0, 0), ring, zero_normals_);
  }

  std::int32_t across_a_cut(int side) const {
    return mesh_.cut_twin.empty() ? -1 : mesh_.cut_twin[static_cast<std::size_t>(4 * quad_ + side)];
  }

 private:
  bool is(std::string_view name) const { return model_.is(name); }
  static std::size_t index(int i, int j, int n) {
    return static_cast<std::size_t>((j + 1) * (n + 3) + i + 1);
  }
  Point& at(int i, int j) { return points_[index(i, j, size_)]; }

  Point edge(const Point& a, const Point& b, const Point& f, const Point& g, bool outside) const {
    const Point right = fast::quad_edge_point(a, b, f, g);
    return is("outer_edges_as_midpoints") && outside ? fast::midpoint(a, b) : right;
  }
  // `inner`: the points next to v, e and w inside the quad.
  Point curve(const Point& v, const Point& e, const Point& w, const std::array<Point, 3>& inner) const {
    if (!is("curve_by_ghosts")) return fast::curve_vertex(v, e, w);
    const auto across = [](const Point& at, const Point& inside) {
      const Point exact = 2. * at - inside;
      const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
      const Point ghost{rounded(exact.x), rounded(exact.y), rounded(exact.z)};
      return .125 * ((inside + ghost) + 6. * at);
    };
    return .125 * ((across(e, inner[1]) + across(w, inner[2])) + 6. * across(v, inner[0]));
  }

  void gather(int k, std::int32_t h) {
    const fast::QuadAdjacency& adjacency = mesh_.adjacency;
    const std::int32_t v = adjacency.origin(h);
    const auto fan = adjacency.fan(v);
    Star& star = stars_[k];
    star.gather(mesh_, v, [&](std::int32_t w) {
      const auto& x = mesh_.positions[static_cast<std::size_t>(w)];
      return Point{x[0], x[1], x[2]};
    });
    if (is("held_corners_move") && star.star.kind == fast::VertexKind::kHeld)
      star.star.kind = fast::VertexKind::kPlain;
    sector_[k] = static_cast<int>(std::find(fan.begin(), fan.end(), h) - fan.begin());
    if (is("ring_shifted_by_one") && !star.star.open && star.star.faces != 4)
      sector_[k] = (sector_[k] + 1) % star.star.faces;
    if (is("window_not_wrapped") && !star.star.open && star.star.faces == 3) wrapped_[k] = true;
  }

  Vertex corner_limit(int k) {
    Star& own = stars_[k];
    const fast::QuadStar<double>& star = own.star;
    const bool smooth_dart = is("dart_by_the_smooth_mask") && star.kind == fast::VertexKind::kDart;
    const auto& weights = weights_.of(star.faces, smooth_dart ? false : star.open,
                                      smooth_dart ? fast::VertexKind::kPlain : star.kind);
    fast::QuadStar<double> seen = star;
    if (smooth_dart) seen.open = false, seen.kind = fast::VertexKind::kPlain;
    const fast::LimitFrame<double> limit = fast::star_limit(seen, weights);
    Star copy;
    copy.resize(star.faces, star.open, star.kind);
    copy.star.centre = star.centre;
    std::copy_n(star.ring, star.size(), copy.star.ring);
    bool degenerate = false;
    const Point normal = fast::star_normal(limit, copy, degenerate);
    return {limit.position, normal + Point{0, 0, 0}};
  }

  void subdivide(int k) {
    Star& star = stars_[k];
    const Point before = star.star.centre;
    star.subdivide();
    if (is("sums_over_n") && !star.star.open && star.star.faces != 4)
      star.star.centre = before + (star.star.faces / 4.) * (star.star.centre - before);
  }

  // What the rings know of the rows and columns beyond the sides.
  void put_beyond() {
    const int n = size_;
    const int left[4][2] = {{-1, 0}, {n, -1}, {n + 1, n}, {0, n + 1}},
              right[4][2] = {{0, -1}, {n + 1, 0}, {n, n + 1}, {-1, n}};
    for (int k = 0; k < 4; ++k) {
      const fast::QuadStar<double>& star = stars_[k].star;
      const int s = sector_[k];
      if (star.has_face(s + 1)) at(left[k][0], left[k][1]) = star.edge(wrapped_[k] ? s : s + 2);
      if (star.has_face(s - 1)) at(right[k][0], right[k][1]) = star.edge(s - 1);
    }
  }

  bool irregular(int side) const {
    const auto &from = stars_[side].star, &to = stars_[(side + 1) % 4].star;
    return !from.open && !to.open && (from.faces == 5 || to.faces == 5);
  }
  // The bicubic B-spline of the points of the control mesh around a side.
  Vertex polynomial(int side, int i, int j) {
    static constexpr int kAlong[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const int n = size_, x = kAlong[side][0], y = kAlong[side][1];
    Vertex v = fast::quad_vertex_limit<double, Surface>(
        at(i, j),
        {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), at(i - 1, j + 1), at(i - 1, j), at(i - 1, j - 1),
         at(i, j - 1), at(i + 1, j - 1)},
        zero_normals_);
    const double t = (side == 0   ? i
                      : side == 1 ? j
                      : side == 2 ? n - i
                                  : n - j) /
                     static_cast<double>(n),
                 u = 1 - t;
    const double along[] = {u * u * u, 4 + t * t * (3 * t - 6), 4 + u * u * (3 * u - 6), t * t * t},
                 across[] = {1, 4, 1};
    v.position = {};
    for (int k = -1; k <= 2; ++k)
      for (int r = -1; r <= 1; ++r)
        v.position = v.position +
                     (along[k + 1] * across[r + 1] / 36) *
                         control_[index(kCornerI[side] + k * x - r * y, kCornerJ[side] + k * y + r * x, 1)];
    return v;
  }

  const QuadKernelModel& model_;
  const fast::QuadMesh& mesh_;
  std::int32_t quad_;
  int size_ = 1;
  std::array<bool, 4> sharp_{}, wrapped_{};
  std::array<Star, 4> stars_;
  std::array<int, 4> sector_{};
  std::array<Vertex, 4> limits_;
  std::vector<Point> points_, control_;
  fast::StarWeightTable<double> weights_;
  std::int64_t zero_normals_ = 0;
};

QuadKernelModel::QuadKernelModel(const data::ControlMesh& mesh, std::string_view mutation)
    : mutation_(mutation), mesh_(mesh) {
  if (mesh_.semi_sharp()) throw SubjectError(LC_NOT_SUPPORTED, "semi-sharp edges or vertices");
  std::size_t first = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    first_corner_.push_back(first);
    corners_.push_back(mesh.faces[f].size());
    first += corners_.back();
  }
  grids_.resize(static_cast<std::size_t>(mesh_.adjacency.face_count()));
}

const QuadKernelModel::Grid& QuadKernelModel::grid(std::int32_t quad, int depth) {
  Grid& known = grids_[static_cast<std::size_t>(quad)];
  if (known.depth == depth) return known;
  known.depth = depth;
  known.points.clear();
  Lattice lattice(*this, quad);
  for (int level = 0; level < depth; ++level) lattice.refine(level + 2 == depth);
  const int n = 1 << depth;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) known.points.push_back(lattice.limit(i, j));
  if (is("normals_of_the_other_side")) {
    // Along a cut: those that the quad beyond has there.
    for (int side = 0; side < 4; ++side) {
      const std::int32_t twin = lattice.across_a_cut(side);
      if (twin < 0) continue;
      Lattice beyond(*this, twin / 4);
      for (int level = 0; level < depth; ++level) beyond.refine(level + 2 == depth);
      const auto on = [n](int k, int t) {
        const int i[] = {t, n, n - t, 0}, j[] = {0, t, n, n - t};
        return std::array{i[k], j[k]};
      };
      for (int t = 1; t < n; ++t) {
        const auto here = on(side, t), there = on(twin % 4, n - t);
        known.points[static_cast<std::size_t>(here[1] * (n + 1) + here[0])].normal =
            beyond.limit(there[0], there[1]).normal;
      }
    }
  }
  return known;
}

QuadKernelModel::Vertex QuadKernelModel::at(std::size_t face, std::int32_t part, std::int64_t i,
                                            std::int64_t j, int level) {
  auto x = static_cast<int>(i), y = static_cast<int>(j);
  auto quad = static_cast<std::int32_t>(face);
  int depth = level;
  if (mesh_.steps == 1) {
    depth = level - 1;
    const int n = 1 << level, h = n / 2;
    auto corner = static_cast<std::size_t>(part);
    if (corners_[face] == 4) {
      corner = y > h ? (x > h ? 2 : 3) : (x > h ? 1 : 0);
      const int u[] = {x, y, n - x, n - y}, v[] = {y, n - x, n - y, x};
      x = u[corner], y = v[corner];
    } else if (is("parts_turned_by_one")) {
      corner = (corner + 1) % corners_[face];
    }
    quad = static_cast<std::int32_t>(first_corner_[face] + corner);
  }
  const int n = 1 << depth;
  if (is("rows_from_the_other_end")) y = n - y;
  if (is("quarter_turn_lost") && quad % 2 == 1) {
    const int turned = y;
    y = n - x, x = turned;
  }
  return grid(quad, depth).points[static_cast<std::size_t>(y * (n + 1) + x)];
}

std::span<const Mutation> quad_kernel_mutations() {
  static const std::vector<Mutation> list{
      {"rows_from_the_other_end", "a kernel's rows are delivered in the opposite order", "positions"},
      {"quarter_turn_lost", "every other quad begins at the next corner and is delivered as if it did not",
       "positions"},
      {"corner_one_level_short", "the recursion of corners stops a level short", "positions"},
      {"ring_shifted_by_one", "an irregular corner's ring of 2n points is read from the next sector on",
       "positions"},
      {"window_one_entry_short", "the window of a ring ends an entry short", "positions"},
      {"window_not_wrapped", "the window of a ring of valence 3 does not wrap", "positions"},
      {"stale_lane", "the last lane of a batch keeps a corner of the quad before", "positions"},
      {"row_of_another_slot", "a row of the last level is taken from another place in the window of rows",
       "positions"},
      {"sums_over_n", "the sums of a ring are weighted by n where n^2 is meant", "positions"},
      {"outer_edges_as_midpoints", "edge points beyond a side are midpoints, as on a boundary", "positions"},
      {"polynomial_at_valence_5", "a side with an end of valence 5 is taken for a polynomial", "positions"},
      {"parts_turned_by_one", "parts of faces that are no quads are those of the next corner", "positions"},
      {"rows_then_columns",
       "points on the sides by the separable rule, rows first: other bits from the quad "
       "that lies turned",
       "shared-positions"},
      {"neighbours_first", "middles of faces add neighbours before diagonals: other bits from another corner",
       "shared-positions"},
      {"fused_normals", "one product of the normal's two is fused: other bits from the quad that lies turned",
       "shared-normals"},
      {"normals_of_the_other_side", "along a cut a quad has the normals of the quad beyond", "normals", "",
       false, true},
      {"curve_by_ghosts", "points on a cut from ghosts beyond it, which were rounded to float",
       "shared-positions", "", false, true},
      {"dart_by_the_smooth_mask", "the end of a crease has the limit of a smooth vertex", "positions", "",
       false, true},
      {"held_corners_move", "corners where three creases meet follow the rule of a crease", "positions", "",
       false, true},
  };
  return list;
}

}  // namespace limitcheck::verify
