// SPDX-License-Identifier: MIT
#include "verify/proof/proof_set.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "data/bounding_box.h"
#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "fast/stream/stream_tessellator.h"
#include "fast/window/tessellator.h"
#include "reference/surface/certified.h"

namespace limitcheck::verify {

namespace {

// A few roundings of the sums below, upward.
constexpr double kUpward = 1 + 0x1p-48;

// What bounds of row streaming lose from one size of the box to another (bounds_test.cpp: 2 %).
constexpr double kNearlyProportional = 1.02;

// Placing rounds a control coordinate by at most 2^-25 of the unit; the sizes of the weights of a derivative by a
// face's parameter sum to 2 at regular points and, at the lattice points of depth 4, to at most 2 (2 lambda)^4 < 6
// near vertices of many faces, lambda < .655 [Stam 1998]; there are three coordinates.
const double kTangentPlacing = std::sqrt(3.) * 6 * 0x1p-25;

fast::IndexedMesh<float> tessellate(ProvedKernel kernel, const data::ControlMesh& mesh, int depth) {
  const fast::TessellatorOptions options{.provenance = true, .scheme = data::natural_scheme(mesh)};
  const std::vector<std::int32_t> depths(mesh.faces.size(), depth);
  fast::IndexedMesh<float> out;
  if (kernel == ProvedKernel::kSlidingWindow)
    fast::Tessellator<float>(mesh, options).frame(depths, out);
  else
    fast::row_stream::StreamTessellator(mesh, options).frame(depths, out);
  return out;
}

double diagonal(const data::ControlMesh& mesh) {
  for (const auto& p : mesh.positions)
    for (const double x : p)
      if (static_cast<double>(static_cast<float>(x)) != x)
        throw data::ArgumentError("certified comparison: a coordinate is not a float");
  return data::box_diagonal(mesh) / kUpward;
}

struct Read {
  double value, radius;  // |true value - value| <= radius
};
Read read(const reference::Enclosure& e) {
  double value = 0;
  const auto [end, error] = std::from_chars(e.value.data(), e.value.data() + e.value.size(), value);
  if (error != std::errc() || end != e.value.data() + e.value.size())
    throw std::logic_error("certified comparison: not a number: " + e.value);
  return {value, (e.radius.as_double() + 0x1p-53 * std::abs(value)) * kUpward};
}

// For conditions, which need no more than a few digits.
fast::Vec3<double> middle(const reference::Enclosure3& e) {
  return {read(e[0]).value, read(e[1]).value, read(e[2]).value};
}

// Upper bound of the distance of a float vector from an enclosure.
double distance(const reference::Enclosure3& exact, const fast::Vec3<float>& found, double& radius) {
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const Read e = read(exact[c]);
    const double difference = std::abs(static_cast<double>(found[c]) - e.value) * kUpward + e.radius;
    square += difference * difference;
    radius = std::max(radius, e.radius);
  }
  return std::sqrt(square) * kUpward;
}

}  // namespace

CertifiedErrors compare_certified(ProvedKernel kernel, const data::ControlMesh& mesh, int depth, int points,
                                  int digits) {
  const double box = diagonal(mesh);
  const auto tessellation = tessellate(kernel, mesh, depth);
  const reference::CertifiedEvaluator evaluator(mesh, data::natural_scheme(mesh));
  CertifiedErrors errors;
  double largest = 0;
  for (const auto& p : mesh.positions)
    for (const double x : p) largest = std::max(largest, std::abs(x));
  const double unit = 2 * std::exp2(std::ceil(std::log2(largest)));
  errors.unit = unit / box;
  const std::size_t count = tessellation.vertices.size();
  const std::size_t step = std::max<std::size_t>(1, count / static_cast<std::size_t>(std::max(points, 1)));
  for (std::size_t k = step / 2; k < count; k += step) {
    const fast::LatticePoint& at = tessellation.provenance[k];
    const auto l1 = reference::Parameter::fraction(at.i, at.denominator);
    const auto l2 = reference::Parameter::fraction(at.j, at.denominator);
    const reference::CertifiedPoint exact = evaluator.evaluate(at.face, at.corner, l1, l2, digits);
    double radius = 0;
    const double position =
        distance(exact.position, tessellation.vertices[k].position, radius) / box * kUpward;
    errors.radius = std::max(errors.radius, radius / box);
    ++errors.points;
    if (position > errors.position) {
      errors.position = position;
      errors.face = at.face, errors.corner = at.corner, errors.l1 = l1.to_string(),
      errors.l2 = l2.to_string();
    }
    if (exact.normal_kind != reference::NormalKind::kRegular || !exact.first_exist) continue;
    const fast::Vec3<double> d1 = middle(exact.d1), d2 = middle(exact.d2);
    const double product = length(fast::cross(d1, d2)) / unit / unit;
    if (!(product > 0x1p-30 * (length(d1) / unit) * (length(d2) / unit))) continue;  // parallel, or one is 0
    errors.condition = std::max(errors.condition, 1 / product);
    errors.placing = std::max(errors.placing, kTangentPlacing * (length(d1) + length(d2)) / unit / product);
    // The unit vector is at least as near to the found one, of whatever length, as to the line along it.
    double ignored = 0;
    const double sine = distance(exact.normal, tessellation.vertices[k].normal, ignored);
    const double angle = sine < 1 ? std::asin(sine) * 180 / std::numbers::pi * kUpward : 180;
    errors.normal = std::max(errors.normal, angle);
  }
  return errors;
}

double ProvedBounds::position_of(const CertifiedErrors& errors) const {
  return std::sqrt(3.) * (kNearlyProportional * position + 0x1p-24) * errors.unit;
}
double ProvedBounds::normal_of(const CertifiedErrors& errors) const {
  const double sine = kNearlyProportional * product * errors.condition + errors.placing;
  return sine < 1 ? (std::asin(sine) + 0x1p-23) * 180 / std::numbers::pi : 180;
}

std::vector<CertifiedLine> stock_shape_lines(const std::vector<ProvedKernel>& kernels, int depth,
                                             data::Scheme scheme) {
  const std::vector<std::string> quads{"quad-cube",    "quad-torus",    "quad-wheel:3", "quad-wheel:5",
                                       "quad-wheel:8", "quad-wheel:50", "quad-fan:1",   "quad-fan:2",
                                       "quad-fan:3",   "pawn",          "prism:5",      "mixed-pawn",
                                       "mixed:1:60",   "creased-cube",  "crease-ring"};
  std::vector<CertifiedLine> lines;
  for (const std::string& name : scheme == data::Scheme::kLoop ? data::stock_shapes() : quads)
    for (const ProvedKernel kernel : kernels) lines.push_back({name, name_of(kernel), depth, {}});
  return lines;
}

void certify(std::vector<CertifiedLine>& lines, int points) {
  tbb::parallel_for(std::size_t{0}, lines.size(), [&](std::size_t k) {
    CertifiedLine& line = lines[k];
    line.errors =
        compare_certified(kernel_named(line.kernel), data::named_mesh(line.mesh), line.depth, points);
  });
}

}  // namespace limitcheck::verify
