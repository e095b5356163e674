// SPDX-License-Identifier: MIT
// A subject whose points lie anywhere: 2^depth + 1 steps to a side, and one triangle of each face cut in three at its
// middle. The points that faces share are evaluated once.
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>

#include "reference/surface/surface.h"
#include "verify/subject/adapter.h"
#include "verify/subject/face_domain.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

class AnywhereSubject {
 public:
  static constexpr std::int32_t kSchemes = LC_DOES_LOOP | LC_DOES_CATMULL_CLARK;
  static lc_capabilities capabilities(Options&, lc_scheme) {
    lc_capabilities c{};
    c.precision = LC_FLOAT64;
    c.max_depth = 6;
    c.normals = c.per_face_depth = c.exact_lattice = 1;
    c.does_not_validate = 1;
    c.points_anywhere = 1;
    return c;
  }

  AnywhereSubject(const lc_mesh& mesh, Options&)
      : mesh_(control_mesh(mesh)), scheme_(scheme_of(mesh.scheme)), surface_(mesh_, scheme_) {}

  void tessellate(const lc_request& request, lc_tessellation& out) {
    // One depth for all, or edges would have points of one face and not of the other.
    const auto deepest = *std::max_element(request.face_depth, request.face_depth + mesh_.faces.size());
    DeliveredArrays made;
    shared_.clear();  // which face is asked first depends on which are culled
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
      if (request.face_depth[f] >= 0) add_face(static_cast<std::int32_t>(f), deepest, made);
    made.hand_over<double>(request, out, true, scheme_ == data::Scheme::kCatmullClark);
  }

 private:
  using Point = FaceDomain::Point;
  using Evaluated = reference::SurfacePoint<double>;

  void add_face(std::int32_t face, int depth, DeliveredArrays& made) {
    const auto corners = mesh_.faces[static_cast<std::size_t>(face)];
    const FaceDomain domain(scheme_, static_cast<int>(corners.size()));
    const std::int64_t steps = ((std::int64_t{1} << depth) + 1) * (scheme_ == data::Scheme::kLoop ? 1 : 2);
    constexpr std::int64_t kFiner = 3;  // for the middle of a triangle
    const std::int64_t whole = kFiner * steps;
    std::map<std::array<std::int64_t, 3>, std::uint32_t> known;
    const auto vertex = [&](const Point& named) {
      const Point p = domain.canonical(named, whole);
      const auto found = known.try_emplace({p.part, p.i, p.j}, 0);
      std::uint32_t& number = found.first->second;
      if (!found.second) return number;
      const auto denominator = static_cast<std::uint32_t>(domain.denominator(whole));
      const lc_provenance place{face, static_cast<std::uint32_t>(p.i), static_cast<std::uint32_t>(p.j),
                                denominator};
      const auto evaluated = [&] {
        return surface_.evaluate(face, p.part, reference::Parameter::fraction(place.i, denominator),
                                 reference::Parameter::fraction(place.j, denominator),
                                 reference::Order::kFirst);
      };
      const auto side = domain.side_of(p, whole);
      const auto make = [&](const Evaluated& e) {
        return number = made.add_vertex(e.position, e.normal, place, p.part);
      };
      if (!side) return make(evaluated());
      const std::int32_t from = corners[static_cast<std::size_t>(side->side)],
                         to = corners[static_cast<std::size_t>(domain.next(side->side))];
      const std::array<std::int64_t, 4> shared =
          side->along == 0 ? std::array<std::int64_t, 4>{from, from, 0, 1}
          : from < to      ? std::array<std::int64_t, 4>{from, to, side->along, whole}
                           : std::array<std::int64_t, 4>{to, from, whole - side->along, whole};
      const auto once = shared_.find(shared);
      return make(once != shared_.end() ? once->second : shared_.emplace(shared, evaluated()).first->second);
    };
    bool cut = false;
    domain.for_each_triangle(steps, 1, [&](Point a, Point b, Point c) {
      for (Point* p : {&a, &b, &c}) p->i *= kFiner, p->j *= kFiner;
      const auto add = [&](const Point& x, const Point& y, const Point& z) {
        made.add_triangle({vertex(x), vertex(y), vertex(z)}, face);
      };
      if (std::exchange(cut, true)) return add(a, b, c);
      const Point middle{(a.i + b.i + c.i) / 3, (a.j + b.j + c.j) / 3, a.part};
      add(a, b, middle), add(b, c, middle), add(c, a, middle);
    });
  }

  const data::ControlMesh mesh_;
  const data::Scheme scheme_;
  const reference::Surface surface_;
  std::map<std::array<std::int64_t, 4>, Evaluated> shared_;  // by edge, and how far along it
};

}  // namespace
}  // namespace limitcheck::verify

extern "C" const lc_subject* lc_subject_anywhere() {
  static const lc_subject subject = limitcheck::verify::make_subject<limitcheck::verify::AnywhereSubject>(
      "anywhere", "the exact surface at points that are on no lattice", nullptr);
  return &subject;
}
