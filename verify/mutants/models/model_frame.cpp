// SPDX-License-Identifier: MIT
#include "verify/mutants/models/model_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "reference/point/normal.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {
namespace {

using V = ModelRules::V;

// To so many bits after the point.
V rounded(const V& p, int bits) {
  const auto one = [&](double x) { return std::ldexp(std::nearbyint(std::ldexp(x, bits)), -bits); };
  return {one(p.x), one(p.y), one(p.z)};
}

// To so many bits in all.
V shortened(const V& p, int bits) {
  const auto one = [&](double x) { return x == 0 ? x : rounded({x, 0, 0}, bits - 1 - std::ilogb(x)).x; };
  return {one(p.x), one(p.y), one(p.z)};
}

double one_ulp_up(double x) {
  return std::nextafter(x, std::numeric_limits<double>::infinity());
}

}  // namespace

ModelFrame::ModelFrame(const ModelMesh& mesh, const ModelRules& rules, std::span<const std::int32_t> depth)
    : mesh_(mesh),
      rules_(rules),
      depth_(depth),
      level_(mesh, rules, *std::max_element(depth.begin(), depth.end()), depth) {
  for (std::size_t f = 0; f < depth.size(); ++f)
    if (depth[f] >= 0) display(f);
  if (rules_.is("crack_at_depth_steps") || rules_.is("chords_at_depth_steps")) at_depth_steps();
}

void ModelFrame::display(std::size_t f) {
  const int d = depth_[f];
  std::array<int, 3> edge{};
  int deeper = 0;
  for (int k = 0; k < 3; ++k) {
    const int other = mesh_.neighbour_depth(depth_, f, k);
    edge[k] = std::max(d, other);
    deeper += other > d;
  }
  if (rules_.is("exchanged_depths") && deeper > 0)
    for (int k = 0; k < 3; ++k) edge[k] = mesh_.neighbour_depth(depth_, f, k);
  if (rules_.is("no_repair") || rules_.is("chords_at_depth_steps") ||
      (rules_.is("fan_needs_two") && deeper == 1))
    deeper = 0;
  const bool tagged = !mesh_.control.sharpness.empty();
  const bool fans = d < 2 || rules_.is("one_inner_point") || rules_.is("exchanged_depths");
  if (deeper == 0) {
    tiles(f, even_tiles(d));
    if (rules_.is("one_strip_more")) repeat_tile_of(triangles.size() - 1);
  } else if (tagged && d < 2) {  // the centre of a fan is no lattice point
    tiles(f, cut_tiles(d, edge));
  } else if (fans) {
    fan(f, edge);
  } else {
    tiles(f, stitched_tiles(d, edge, rules_.is("inner_t_vertices") ? 2 : 1));
  }
}

void ModelFrame::repeat_tile_of(std::size_t t) {
  triangles.push_back(std::array(triangles[t]));
  faces.push_back(std::int32_t{faces[t]});
}

// Where a face meets a shallower one, its border points on that side.
void ModelFrame::at_depth_steps() {
  for (Vertex& v : vertices) {
    const auto f = static_cast<std::size_t>(v.place.face);
    const auto at = FaceDomain::triangle().side_of(point_of(v.place), v.place.denominator);
    if (!at || at->along == 0) continue;
    const int other = mesh_.neighbour_depth(depth_, f, at->side);
    if (other >= depth_[f]) continue;
    if (rules_.is("crack_at_depth_steps")) v.position.x = one_ulp_up(v.position.x);
    if (rules_.is("chords_at_depth_steps")) {
      const int steps = static_cast<int>(at->along) << other, n = static_cast<int>(v.place.denominator);
      const V a = border_point(f, at->side, steps / n, other);
      const V b = border_point(f, at->side, steps / n + 1, other);
      if (steps % n != 0) v.position = a + (b - a) * (static_cast<double>(steps % n) / n);
    }
  }
}

ModelRules::V ModelFrame::border_point(std::size_t f, int k, int s, int d) const {
  const int depth = level_.mesh.depth();
  const FaceDomain::Point p = FaceDomain::triangle().on_side(k, s << (depth - d), std::int64_t{1} << depth);
  return level_.limits[level_.mesh.vertex(f, static_cast<int>(p.i), static_cast<int>(p.j))];
}

void ModelFrame::triangle(std::size_t f, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  triangles.push_back({a, b, c});
  faces.push_back(static_cast<std::int32_t>(f));
}

void ModelFrame::tiles(std::size_t f, const std::vector<Tile>& list) {
  std::map<TilePoint, std::uint32_t> at;
  const auto vertex = [&](TilePoint p) {
    while (p.depth > 0 && p.i % 2 == 0 && p.j % 2 == 0) p = {p.i / 2, p.j / 2, p.depth - 1};
    const auto [known, is_new] = at.try_emplace(p);
    if (is_new) known->second = put(f, p.i, p.j, p.depth);
    return known->second;
  };
  for (const auto& [a, b, c] : list) {
    const std::uint32_t first = vertex(a), second = vertex(b);
    triangle(f, first, second, vertex(c));
  }
}

void ModelFrame::fan(std::size_t f, const std::array<int, 3>& edge) {
  std::vector<std::uint32_t> border;
  for (int k = 0; k < 3; ++k) {
    const int d = edge[k], n = 1 << d;
    for (int s = 0; s < n; ++s)
      border.push_back(k == 0 ? put(f, s, 0, d) : k == 1 ? put(f, n - s, s, d) : put(f, 0, n - s, d));
  }
  if (!surface_)
    surface_ = std::make_unique<reference::StamEvaluator<double>>(mesh_.control, rules_.weights());
  const auto third = reference::Parameter::fraction(1, 3);
  const auto centre = surface_->evaluate(static_cast<int>(f), third, third, reference::Order::kFirst);
  Vertex out{centre.position, centre.normal, {static_cast<std::int32_t>(f), 1, 1, 3}};
  const auto control = [&](int k) {
    const auto& p = mesh_.control.positions[triangles_of(mesh_.control)[f][k]];
    return V{p[0], p[1], p[2]};
  };
  const auto corner = [&](int k) {
    const int n = 1 << level_.mesh.depth();
    return level_.limits[level_.mesh.vertex(f, k == 1 ? n : 0, k == 2 ? n : 0)];
  };
  const bool at_boundary =
      mesh_.neighbour(f, 0) < 0 || mesh_.neighbour(f, 1) < 0 || mesh_.neighbour(f, 2) < 0;
  if (rules_.is("flat_centre")) out.position = (corner(0) + corner(1) + corner(2)) * (1. / 3);
  if (rules_.is("control_centroid")) out.position = (control(0) + control(1) + control(2)) * (1. / 3);
  if (rules_.is("flat_centre_normal"))
    out.normal = reference::unit(cross(control(1) - control(0), control(2) - control(0)));
  if (rules_.is("centre_without_ghosts") && at_boundary) {
    out.position = {};
    for (const auto b : border)
      out.position += vertices[b].position * (1 / static_cast<double>(border.size()));
  }
  if (rules_.is("printed_b1") && !at_boundary) {
    // b1 weighs the first of the twelve points: neighbour 4, from the next corner on, of the edge point.
    reference::RefinedMesh<double> once(mesh_.control);
    once.refine();
    const std::int32_t four = once.vertex(f, 1, 0), seven = once.vertex(f, 1, 1);
    const auto ring = once.topology().ring(four);
    const auto first = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), seven) - ring.begin());
    const V& one = once.positions()[ring[(first + 4) % ring.size()]];
    out.position += one * ((11. / 108 - 1. / 4) / 81);
  }
  vertices.push_back(out);
  const auto middle = static_cast<std::uint32_t>(vertices.size() - 1);
  for (std::size_t k = 0; k < border.size(); ++k)
    triangle(f, middle, border[k], border[(k + 1) % border.size()]);
  if (rules_.is("fan_twice")) repeat_tile_of(triangles.size() - 1);
}

// The limit point as it is at a place, and what a mutant makes of it.
std::uint32_t ModelFrame::put(std::size_t f, int i, int j, int d) {
  const int times = 1 << (level_.mesh.depth() - d), n = 1 << d;
  const auto vertex = [&](int a, int b) {
    const int step = a * times;
    return level_.mesh.vertex(f, rules_.is("rows_of_7_bits") ? step & 127 : step, b * times);
  };
  const auto v = static_cast<std::size_t>(vertex(i, j));
  Vertex out{level_.limits[v],
             level_.normal(f, i * times, j * times),
             {static_cast<std::int32_t>(f), static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j),
              static_cast<std::uint32_t>(n)}};
  const bool border = i == 0 || j == 0 || i + j == n, odd = f % 2 == 1;
  const auto outwards = [&](double by) { out.position += out.normal * (by * mesh_.size); };
  if (rules_.is("sides_apart_by_an_ulp") && odd && level_.sides.contains(static_cast<std::int32_t>(v)))
    out.position.x = one_ulp_up(out.position.x);
  if (rules_.is("gap_1e-9") && border && odd) outwards(1e-9);
  if (rules_.is("by_face_number") && !border && odd) outwards(1e-9);
  if (rules_.is("by_first_corner") && !border) outwards(1e-9 * (n - i - j) / n);
  if (rules_.is("last_face") && !border && f + 1 == mesh_.control.faces.size()) outwards(1e-6);
  if (rules_.is("bias_3e-6")) outwards(3e-6);
  if (rules_.is("right_half") && out.position.x > 0) out.position.y += 1e-9 * mesh_.size;
  if (rules_.is("along_z")) out.position.z *= 1 + 1e-9;
  if (rules_.is("about_origin")) out.position *= 1 + 1e-9;
  if (rules_.is("absolute_offset")) out.position += V{1e-9, 1e-9, 1e-9};
  if (rules_.is("float_positions")) out.position = shortened(out.position, 24);
  if (rules_.is("half_positions")) out.position = shortened(out.position, 11);
  if (rules_.is("float_normals")) out.normal = shortened(out.normal, 24);
  if (rules_.is("fixed_point")) out.position = rounded(out.position, 40);
  if (rules_.is("grid_of_largest"))
    out.position = rounded(out.position * (1 / mesh_.largest), 32) * mesh_.largest;
  if (rules_.is("hard_edges") && border && odd) {
    const auto corner = [&](int k) { return border_point(f, k, 0, 0); };
    out.normal = reference::unit(cross(corner(1) - corner(0), corner(2) - corner(0)));
  }
  if (rules_.is("phong_normals"))
    out.normal = reference::unit(level_.normals[vertex(0, 0)] * (n - i - j) +
                                 level_.normals[vertex(n, 0)] * i + level_.normals[vertex(0, n)] * j);
  if (rules_.is("sums_begun_in_face"))
    out.position = rules_.limit(level_.mesh.topology(), level_.points, static_cast<std::int32_t>(v),
                                level_.mesh.depth(), f);
  if (rules_.is("normals_begun_in_face"))
    out.normal = rules_.normal(level_.mesh.topology(), level_.points, static_cast<std::int32_t>(v), f);
  if (rules_.is("faces_sorted")) {
    const auto& corner = triangles_of(mesh_.control)[f];
    const auto lowest = static_cast<int>(std::min_element(corner.begin(), corner.end()) - corner.begin());
    const FaceDomain::Point p = FaceDomain::triangle().moved({i, j}, n, {(3 - lowest) % 3});
    out.place.i = static_cast<std::uint32_t>(p.i);
    out.place.j = static_cast<std::uint32_t>(p.j);
  }
  if (rules_.is("edges_sorted") && j == 0 &&
      triangles_of(mesh_.control)[f][0] > triangles_of(mesh_.control)[f][1])
    out.place.i = out.place.denominator - out.place.i;
  vertices.push_back(out);
  return static_cast<std::uint32_t>(vertices.size() - 1);
}

}  // namespace limitcheck::verify
