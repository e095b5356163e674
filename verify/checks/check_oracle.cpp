// SPDX-License-Identifier: MIT
#include "verify/checks/check_oracle.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "data/cut_out.h"
#include "data/splitmix64.h"
#include "reference/mesh/support.h"
#include "reference/number/number_exact.h"
#include "reference/surface/surface.h"
#include "verify/evidence/faces_around.h"
#include "verify/evidence/reference_surface.h"
#include "verify/interrupt/interrupt.h"
#include "verify/subject/adapter.h"
#include "verify/subject/lattice.h"

namespace limitcheck::verify {
namespace {

using data::ControlMesh, reference::CertifiedPoint, reference::Enclosure3, reference::Parameter;
using Big = reference::Decimal50;
namespace cc = reference::catmull_clark;

// Semi-sharp tags of more steps make the whole mesh in double too large.
constexpr int kMostStepsOfWhole = 5;
constexpr double kMostExcess = 1e300;   // where nothing may differ
constexpr std::size_t kMostFaces = 16;  // of a vertex that are asked

Parameter first(const Place& p) {
  return Parameter::fraction(p.i, p.denominator);
}
Parameter second(const Place& p) {
  return Parameter::fraction(p.j, p.denominator);
}

Result row_of(const AuditMesh& mesh, const char* check) {
  Result row;
  row.subject = "oracle", row.mesh = mesh.name, row.check = check;
  row.scheme = mesh.scheme();
  row.status = Status::kHeld;
  row.bound = 1, row.unit = "bounds", row.worst = 0;
  return row;
}

Big big(const reference::Radius& r) {
  return Big(r.to_string(17));
}

Big size_of(const reference::Enclosure& e) {
  return abs(Big(e.value));
}

// How far apart, by how far they may be.
double ratio(const Big& apart, const Big& may) {
  return apart == 0 ? 0 : may == 0 ? kMostExcess : Big(apart / may).convert_to<double>();
}
double excess(const reference::Enclosure& a, const reference::Enclosure& b) {
  return ratio(abs(Big(a.value) - Big(b.value)), big(a.radius) + big(b.radius));
}
double excess(const Enclosure3& a, const Enclosure3& b) {
  return std::max({excess(a[0], b[0]), excess(a[1], b[1]), excess(a[2], b[2])});
}
template <class N>
double excess(const Enclosure3& a, const reference::Vec3<N>& b, double bound) {
  const std::array<N, 3> x{b.x, b.y, b.z};
  double worst = 0;
  for (std::size_t c = 0; c < 3; ++c)
    worst = std::max(worst, ratio(abs(Big(a[c].value) - Big(x[c])), big(a[c].radius) + Big(bound)));
  return worst;
}

// The faces that decide the surface of one, that one first, as a mesh.
ControlMesh part_for(const ControlMesh& whole, const FacesAround& around, std::int32_t face) {
  const std::vector<std::int32_t> faces = reference::support_of(
      {face}, whole.faces, [&](std::int32_t v) { return around.of(v); }, whole.sharpness.creasing);
  data::CutOut cut = data::cut_out(whole.faces, faces);
  ControlMesh part{cut.of(whole.positions), {}, cut.of(whole.sharpness)};
  part.faces = std::move(cut.faces);
  return part;
}

// The whole mesh in 50 digits.
class Whole {
 public:
  Whole(const ControlMesh& mesh, data::Scheme scheme) {
    std::vector<reference::Vec3<Big>> points;
    for (const auto& p : mesh.positions) points.push_back({Big(p[0]), Big(p[1]), Big(p[2])});
    if (scheme == data::Scheme::kLoop)
      evaluator_.emplace<1>(mesh);
    else
      evaluator_.emplace<2>(mesh.faces, std::move(points), mesh.sharpness);
  }
  reference::SurfacePoint<Big> at(const Place& p) const {
    if (const auto* loop = std::get_if<1>(&evaluator_))
      return loop->evaluate(p.face, first(p), second(p), reference::Order::kFirst);
    return std::get<2>(evaluator_).evaluate(p.face, p.corner, first(p), second(p), reference::Order::kFirst);
  }

 private:
  std::variant<std::monostate, reference::StamEvaluator<Big>, cc::StamEvaluator<Big>> evaluator_;
};

// What rounding may do in double. M is the largest coordinate, n the largest number of faces at a vertex or of
// corners of a face, s the number of steps before semi-sharp tags are used up. A step, and the limit behind it,
// is a mean over at most 2 n + 1 points, that is at most 2 n + 8 roundings of M 2^-53, and the next takes errors
// over as they are. A derivative is 8 times the differences of points (StamError::kFirst), and s steps make its
// parameters 2^s times as dense; near a vertex it comes from a power of an eigenvalue, which is off by the
// exponent.
struct DoubleBound {
  double position, derivative, relative;

  DoubleBound(const ControlMesh& mesh, const FacesAround& around, int steps) {
    double largest = 0;
    std::size_t n = 0;
    for (const auto& p : mesh.positions)
      for (const double x : p) largest = std::max(largest, std::abs(x));
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      n = std::max(n, mesh.faces[f].size());
      for (const std::int32_t v : mesh.faces[f]) n = std::max(n, around.of(v).size());
    }
    position = (steps + 2) * static_cast<double>(2 * n + 8) * 0x1p-53 * largest;
    derivative = std::ldexp(8 * position, steps);
    relative = 64 * 0x1p-52;
  }
  double of(const Enclosure3& d) const {
    const Big size = std::max({size_of(d[0]), size_of(d[1]), size_of(d[2])});
    return derivative + relative * size.convert_to<double>();
  }
};

class OracleCheck {
 public:
  OracleCheck(const AuditMesh& mesh, const Oracle& oracle)
      : mesh_(mesh.mesh),
        scheme_(mesh.scheme()),
        oracle_(oracle),
        certify_(oracle(mesh_, scheme_)),
        around_(mesh_.faces, mesh_.positions.size()),
        // One for an edge that stays sharp and has no other at its ends, one for faces that are no quads.
        steps_(steps_of(mesh_.sharpness) + 2),
        bound_(mesh_, around_, steps_),
        rows_{row_of(mesh, "oracle-faces"), row_of(mesh, "oracle-double"), row_of(mesh, "oracle-parts")} {}

  std::vector<Result> run(int points) {
    // Decided by the mesh, not by its name: a smaller one that a finding is shrunk to draws its own.
    std::uint64_t seed = mesh_.faces.size();
    for (const auto& p : mesh_.positions) seed = seed * 31 + std::bit_cast<std::uint64_t>(p[0] + 2 * p[1]);
    data::SplitMix64 random(seed);
    for (int k = 0; k < points; ++k) {
      end_if_interrupted();
      look(random);
    }
    return {rows_.begin(), rows_.end()};
  }

 private:
  std::int32_t drawn_face(data::SplitMix64& random) const {
    const data::Sharpness& tags = mesh_.sharpness;
    const std::size_t count = tags.edges.size() + tags.vertices.size();
    const auto any = [&](std::span<const std::int32_t> of) { return of[random.next() % of.size()]; };
    if (count == 0 || random.next() % 8 == 0)
      return static_cast<std::int32_t>(random.next() % mesh_.faces.size());
    const std::size_t k = random.next() % count;
    const std::int32_t v = k >= tags.edges.size()   ? tags.vertices[k - tags.edges.size()].vertex
                           : random.next() % 2 == 0 ? tags.edges[k].a
                                                    : tags.edges[k].b;
    const std::int32_t face = any(around_.of(v));
    return random.next() % 2 == 0 ? face : any(around_.of(any(mesh_.faces[static_cast<std::size_t>(face)])));
  }

  // Half of the points are vertices, most others on edges; steps of 1/8, or of 2^-12, by chance next to a vertex.
  void look(data::SplitMix64& random) {
    const std::int32_t face = drawn_face(random);
    const Lattice lattice(mesh_, scheme_, random.next() % 2 == 0 ? 3 : 12);
    const FaceDomain domain = lattice.domain(face);
    const auto below = [&](std::int64_t n) {
      return static_cast<std::int64_t>(random.next() % static_cast<std::uint64_t>(n));
    };
    const int side = static_cast<int>(below(domain.corners()));
    const std::int64_t n = lattice.n(), along = 1 + (below(3) == 0 ? 0 : below(n - 1));
    const std::uint64_t kind = random.next() % 8;
    if (kind == 7) {
      const std::int64_t i = 1 + below(n / 2 - 1), j = 1 + below(n / 2 - 1);
      return ask(
          {lattice.place(lattice.id(face, {i, j, static_cast<std::int32_t>(below(domain.parts()))}, n))}, {0},
          false);
    }
    const Lattice::Id id = lattice.id(face, domain.on_side(side, kind < 4 ? 0 : along, n), n);
    const Sides sides(lattice);
    std::vector<Place> places;
    std::vector<Sides::Id> side_of;
    const auto add = [&](std::int32_t f) {
      places.push_back(lattice.place(f, *lattice.in_face(id, f)));
      side_of.push_back(sides.of(id, f));
    };
    if (lattice.is_vertex(id)) {
      // Of a vertex of very many, kMostFaces spread over them.
      const auto all = around_.of(static_cast<std::int32_t>(id));
      const std::size_t asked = std::min(all.size(), kMostFaces), start = random.next() % all.size();
      for (std::size_t k = 0; k < asked; ++k) add(all[(start + k * all.size() / asked) % all.size()]);
    } else {
      for (const std::int32_t f : lattice.edges()[lattice.edge_of(id)].face)
        if (f >= 0) add(f);
    }
    ask(places, side_of, lattice.is_vertex(id));
  }

  // Of one point by each of its faces.
  void ask(const std::vector<Place>& places, const std::vector<Sides::Id>& side, bool vertex) {
    std::vector<CertifiedPoint> points;
    for (const Place& p : places) points.push_back(certify_(p));
    ++rows_[0].of;
    for (std::size_t a = 0; a < points.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        const auto compare = [&](const auto& x, const auto& y, const char* what) {
          note(0, places[a], excess(x, y),
               fmt::format("the balls of its {} asked from faces {} and {} do not meet", what, places[b].face,
                           places[a].face));
        };
        compare(points[a].position, points[b].position, "position");
        if (side[a] != side[b]) continue;
        const auto regular = [](const CertifiedPoint& p) {
          return p.normal_kind == reference::NormalKind::kRegular;
        };
        if (regular(points[a]) && regular(points[b]) && !(vertex && held(places[a])))
          compare(points[a].normal, points[b].normal, "normal");
        if (!vertex && points[a].gaussian_curvature && points[b].gaussian_curvature)
          compare(*points[a].gaussian_curvature, *points[b].gaussian_curvature, "Gaussian curvature");
      }
    const std::size_t k = static_cast<std::size_t>(rows_[0].of) % points.size();
    ControlMesh part = part_for(mesh_, around_, places[k].face);
    Place in_part = places[k];
    in_part.face = 0;
    compare_double(places[k], points[k], part, in_part);
    compare_parts(places[k], points[k], part, in_part);
  }

  // The tip of a cone has a normal in each face.
  bool held(const Place& at) const {
    const auto face = mesh_.faces[static_cast<std::size_t>(at.face)];
    return std::any_of(mesh_.sharpness.vertices.begin(), mesh_.sharpness.vertices.end(), [&](const auto& v) {
      return v.sharpness >= data::kInfiniteSharpness &&
             std::find(face.begin(), face.end(), v.vertex) != face.end();
    });
  }

  void compare_double(const Place& at, const CertifiedPoint& exact, const ControlMesh& part,
                      const Place& in_part) {
    const bool whole = steps_ <= kMostStepsOfWhole;
    if (whole && !double_) double_.emplace(mesh_, scheme_);
    const Place& p = whole ? at : in_part;
    const reference::SurfacePoint<double> s =
        whole ? double_->evaluate(p.face, p.corner, first(p), second(p), reference::Order::kFirst)
              : reference::Surface(part, scheme_)
                    .evaluate(p.face, p.corner, first(p), second(p), reference::Order::kFirst);
    ++rows_[1].of;
    note(1, at, excess(exact.position, s.position, bound_.position), "the position in double is off");
    if (s.first_exist != exact.first_exist)
      note(1, at, 2, "only one of certificate and double has first derivatives");
    if (!s.first_exist || !exact.first_exist) return;
    note(1, at, excess(exact.d1, s.d1, bound_.of(exact.d1)),
         "the derivative in double by the first parameter is off");
    note(1, at, excess(exact.d2, s.d2, bound_.of(exact.d2)),
         "the derivative in double by the second parameter is off");
  }

  void compare_parts(const Place& at, const CertifiedPoint& exact, const ControlMesh& part,
                     const Place& in_part) {
    if (!whole_) whole_.emplace(mesh_, scheme_);
    const reference::SurfacePoint<Big> s = whole_->at(at);
    const CertifiedPoint of_part = oracle_(part, scheme_)(in_part);
    ++rows_[2].of;
    // Of 50 decimals the rounding of the bounds in double, with 10 to spare.
    const double finer = 1e-23;
    note(2, at, excess(exact.position, s.position, finer * bound_.position),
         "the whole mesh has another position");
    note(2, at, excess(exact.position, of_part.position), "the faces around, alone, have another position");
    if (exact.first_exist && s.first_exist) {
      note(2, at, excess(exact.d1, s.d1, finer * bound_.of(exact.d1)),
           "the whole mesh has another derivative");
      note(2, at, excess(exact.d2, s.d2, finer * bound_.of(exact.d2)),
           "the whole mesh has another derivative");
    }
    if (exact.normal_kind == of_part.normal_kind)
      note(2, at, excess(exact.normal, of_part.normal), "the faces around, alone, have another normal");
  }

  // Numbers are `excess` times as far apart as they may be.
  void note(std::size_t row, const Place& at, double excess, const std::string& what) {
    Result& r = rows_[row];
    excess = std::isnan(excess) ? kMostExcess : std::min(excess, kMostExcess);
    if (excess <= *r.worst) {
      r.bad += excess > 1;
      return;
    }
    r.worst = excess;
    if (excess <= 1) return;
    ++r.bad;
    r.status = Status::kFinding;
    r.message = what;
    r.witness =
        Witness{.face = at.face, .l1 = fraction(at.i, at.denominator), .l2 = fraction(at.j, at.denominator)};
    if (scheme_ == data::Scheme::kCatmullClark && mesh_.faces[static_cast<std::size_t>(at.face)].size() != 4)
      r.witness->corner = at.corner;
  }

  const ControlMesh& mesh_;
  data::Scheme scheme_;
  const Oracle& oracle_;
  Certificates certify_;
  FacesAround around_;
  int steps_;
  DoubleBound bound_;
  std::array<Result, 3> rows_;
  std::optional<reference::Surface> double_;
  std::optional<Whole> whole_;
};

class NoTessellator {
 public:
  static constexpr std::int32_t kSharp =
      LC_SHARP_CREASES | LC_SHARP_SEMI | LC_SHARP_CHAIKIN | LC_SHARP_CORNERS | LC_SHARP_SMOOTH_TRIANGLES;
  static lc_capabilities capabilities(Options&, lc_scheme) {
    return {LC_FLOAT64, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 10, 1, 1, 1};
  }
  NoTessellator(const lc_mesh&, Options&) {}
  void tessellate(const lc_request&, lc_tessellation&) {
    throw SubjectError(LC_NOT_SUPPORTED, "the oracle knows points and tessellates nothing");
  }
};

}  // namespace

Oracle the_oracle() {
  return [](const ControlMesh& mesh, data::Scheme scheme) -> Certificates {
    const auto evaluator = std::make_shared<const reference::CertifiedEvaluator>(mesh, scheme);
    return [evaluator](const Place& p) {
      return evaluator->evaluate(p.face, p.corner, first(p), second(p), kOracleDigits);
    };
  };
}

std::vector<Result> check_oracle(const AuditMesh& mesh, int points, const Oracle& oracle) try {
  return OracleCheck(mesh, oracle).run(points);
} catch (const std::bad_alloc&) {
  throw;  // no fault of the oracle's
} catch (const std::exception& error) {
  Result row = row_of(mesh, "oracle-faces");
  row.worst.reset(), row.bound.reset();
  row.status = Status::kError;
  row.bad = row.of = 1;
  row.message = error.what();
  return {row};
}

const lc_subject& oracle_subject() {
  static const lc_subject subject = make_subject<NoTessellator>(
      "oracle", "the reference's certified points, which are checked against each other");
  return subject;
}

}  // namespace limitcheck::verify
