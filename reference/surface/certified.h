// SPDX-License-Identifier: MIT
// Certified points: decimal numbers with radii that are guaranteed to hold the true values.
#pragma once

#include <array>
#include <compare>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "reference/loop/masks.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/mesh/topology.h"
#include "reference/point/parameter.h"
#include "reference/point/surface_point.h"

namespace limitcheck::reference {

/// The radius of a ball, of any size: an upper bound as a decimal with an exponent of its own, so that those of curvatures of 1e600 and of points
/// of 1e-300 are what they are: digits * 10^exponent with 1 <= digits < 10; 0; or infinite.
class Radius {
 public:
  Radius() = default;
  /// Any digits >= 0, infinity included.
  Radius(double digits, long exponent);

  bool is_zero() const { return digits_ == 0; }
  /// Not less: infinite beyond the largest double, and the least above zero below it.
  double as_double() const;
  /// So many significant digits, 1 .. 17, not less: "4.3e-20", "0", "inf".
  std::string to_string(int digits = 2) const;

  friend auto operator<=>(const Radius&, const Radius&) = default;

 private:
  long exponent_ = -(1L << 40);  // of zero; first, as it decides which is larger
  double digits_ = 0;
};

/// |true value - value| <= radius. `value` has as many decimals as were asked for, not more.
struct Enclosure {
  std::string value;
  Radius radius;
};
/// A point or vector.
using Enclosure3 = std::array<Enclosure, 3>;

/// As SurfacePoint; d11, d12, d22 are there if they exist, t1 and t2 at an extraordinary corner only.
/// Curvatures are given where second derivatives and the normal exist, but not at an extraordinary corner,
/// where no two derivatives are independent that have second ones;
/// the mean curvature is positive where the surface is convex: 1/r on a sphere of radius r.
struct CertifiedPoint {
  Enclosure3 position, d1, d2, normal;
  std::optional<Enclosure3> d11, d12, d22, t1, t2;
  std::optional<Enclosure> gaussian_curvature, mean_curvature;
  NormalKind normal_kind;
  bool first_exist;
  DerivativeLimits limits;
  Radius radius;   ///< the largest radius of all but the curvatures, whose own may be huge
  long precision;  ///< bits that were needed
  std::size_t
      faces;  ///< of the mesh that was made to evaluate it: those near, at vertices of many faces a few
};

/// What of a point is wanted. Normals and curvatures say nothing of values that are no positions, and cost digits.
enum class Wanted { kAll, kDerivatives };

/// Stam's evaluator in ball arithmetic (Arb): control points are taken as the exact binary numbers they are,
/// parameters as exact rationals.
class CertifiedEvaluator {
 public:
  /// Loop's scheme, as StamEvaluator; throws data::ArgumentError also if a coordinate is not finite.
  explicit CertifiedEvaluator(const data::ControlMesh& mesh, Weights weights = Weights::kLoop);
  /// Either scheme; Catmull-Clark's as catmull_clark::StamEvaluator.
  CertifiedEvaluator(const data::ControlMesh& mesh, data::Scheme scheme);
  /// Control points as text, "1/3" or "0.125", taken exactly. Throws data::ArgumentError as
  /// Parameter::parse does.
  CertifiedEvaluator(const std::vector<std::array<std::string, 3>>& positions,
                     const std::vector<Triangle>& triangles, Weights weights = Weights::kLoop);
  CertifiedEvaluator(const std::vector<std::array<std::string, 3>>& positions, const data::Faces& faces,
                     data::Scheme scheme, const SharpTags& tags = {});
  ~CertifiedEvaluator();

  /// Evaluates a mesh of only the faces that the surface depends on (mesh/support.h), so that it is quick on
  /// large meshes.
  ///   digits   1..10000 significant digits of the largest coordinate of each vector; each printed value is
  ///            within one unit of its last decimal. Precision rises until that is certain. A vector that
  ///            cannot be told from zero at eight times the digits (and more near a corner, where digits are
  ///            lost) is printed as 0 with its radius
  ///   throws   data::ArgumentError: digits or parameters out of range, no such face
  CertifiedPoint evaluate(int face, const Parameter& l1, const Parameter& l2, int digits) const;
  /// The same with Catmull-Clark's parameters: (u, v) of a quad (corner 0), or of the sub-quad at a corner of
  /// another face, see catmull_clark::SubdivisionEvaluator; d1 and d2 are by u and v. Loop's have the corner
  /// 0.
  CertifiedPoint evaluate(int face, int corner, const Parameter& u, const Parameter& v, int digits,
                          Wanted wanted = Wanted::kAll) const;

  /// Of vertices of more faces, and faces of more corners, only those are built that are near the point, where that is
  /// exact (near_part.h): 1000. Not to be changed while another thread evaluates.
  static int& whole_up_to();

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

}  // namespace limitcheck::reference
