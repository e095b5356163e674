// SPDX-License-Identifier: MIT
// What a subject delivered, in vectors, so that a subject that wraps another can change it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "verify/host/host.h"
#include "verify/subject/adapter.h"

namespace limitcheck::verify {

template <class Real>
struct DeliveredCopy {
  std::vector<std::array<Real, 3>> positions, normals;  // no normals: empty
  std::vector<lc_provenance> provenance;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::int32_t> triangle_face;
};

/// Exact if the subject's precision is Real, rounded to it otherwise.
template <class Real>
DeliveredCopy<Real> copy_of(const Tessellation& good) {
  DeliveredCopy<Real> copy;
  for (std::int64_t v = 0; v < good.vertex_count(); ++v) {
    const auto cast = [](const std::array<double, 3>& p) {
      return std::array<Real, 3>{static_cast<Real>(p[0]), static_cast<Real>(p[1]), static_cast<Real>(p[2])};
    };
    copy.positions.push_back(cast(good.position(v)));
    if (good.has_normals()) copy.normals.push_back(cast(good.normal(v)));
  }
  copy.provenance.assign(good.provenance().begin(), good.provenance().end());
  copy.triangles.assign(good.triangles().begin(), good.triangles().end());
  copy.triangle_face.assign(good.triangle_face().begin(), good.triangle_face().end());
  return copy;
}

/// Fills arrays of as many elements.
template <class Real>
void fill(const Output<Real>& output, const DeliveredCopy<Real>& copy) {
  for (std::size_t k = 0; k < copy.positions.size(); ++k) {
    std::copy(copy.positions[k].begin(), copy.positions[k].end(), output.positions + 3 * k);
    if (output.normals != nullptr)
      std::copy(copy.normals[k].begin(), copy.normals[k].end(), output.normals + 3 * k);
  }
  std::copy(copy.provenance.begin(), copy.provenance.end(), output.provenance);
  for (std::size_t k = 0; k < copy.triangles.size(); ++k)
    std::copy(copy.triangles[k].begin(), copy.triangles[k].end(), output.triangles + 3 * k);
  std::copy(copy.triangle_face.begin(), copy.triangle_face.end(), output.triangle_face);
}

}  // namespace limitcheck::verify
