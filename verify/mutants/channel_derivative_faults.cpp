// SPDX-License-Identifier: MIT
// Faults of the derivatives of channels, planted in a subject that delivers them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "verify/mutants/channel_rows.h"

namespace limitcheck::verify {

using namespace rows;

namespace {

using data::ChannelRule;

// Of each corner of each triangle: its two derivatives by the first parameter, then those by the second.
Change derivatives(const std::string& name,
                   std::function<void(A, std::vector<double>&, const Delivered&)> what,
                   std::function<bool(A)> shows = {}) {
  const auto all = [what](A a, D out) {
    if (out.channel_derivatives.empty()) nowhere("derivative");
    what(a, out.channel_derivatives, out);
  };
  return of_channels(deliver(name, all), std::move(shows));
}
// Each four numbers.
Change each_derivative(const std::string& name, std::function<void(A, std::size_t face, double* d)> what,
                       std::function<bool(A)> shows = {}) {
  const auto each = [what](A a, std::vector<double>& all, const Delivered& out) {
    for (std::size_t c = 0; 4 * c < all.size(); ++c)
      what(a, static_cast<std::size_t>(out.triangle_face[c / 3]), &all[4 * c]);
  };
  return derivatives(name, each, std::move(shows));
}
// Those of another channel on the same mesh.
Change derivatives_of(const std::string& name, std::function<void(A, Uv)> other) {
  const auto change = [other](A a) { return [other, &a](Mesh m) { other(a, m.channels.front()); }; };
  return derivatives(
      name,
      [change](A a, std::vector<double>& all, const Delivered&) {
        all = again(a, change(a)).channel_derivatives;
      },
      [change](A a) { return changes(a, change(a)); });
}

}  // namespace

void faults_of_channel_derivatives(Rows& to) {
  to += each_derivative("channel_derivatives_swapped",
                        [](A, std::size_t, double* d) { std::swap_ranges(d, d + 2, d + 2); });
  to += each_derivative("channel_derivatives_transposed",
                        [](A, std::size_t, double* d) { std::swap(d[0], d[1]), std::swap(d[2], d[3]); });
  to += each_derivative("channel_derivatives_first_component",
                        [](A, std::size_t, double* d) { d[1] = d[3] = 0; });
  to += each_derivative("channel_derivatives_negated",
                        [](A, std::size_t, double* d) { d[2] = -d[2], d[3] = -d[3]; });
  to += each_derivative("channel_derivatives_by_one_parameter",
                        [](A, std::size_t, double* d) { std::copy_n(d, 2, d + 2); });
  to += each_derivative("channel_derivatives_of_level", [](A a, std::size_t f, double* d) {
    for (int k = 0; k < 4; ++k) d[k] = std::ldexp(d[k], -a.depth[f]);
  });
  to += each_derivative("channel_derivatives_of_unit_length", [](A, std::size_t, double* d) {
    for (int by = 0; by < 4; by += 2)
      if (const double size = std::hypot(d[by], d[by + 1]); size > 0) d[by] /= size, d[by + 1] /= size;
  });
  const auto twice = [](A a, std::size_t f, double* d) {
    for (int k = 0; k < 4 && a.is_polygon(f); ++k) d[k] *= 2;
  };
  to += each_derivative("channel_derivatives_of_polygons", twice, [](A a) { return a.has_polygons(); });
  to += derivatives_of("channel_derivatives_without_seams",
                       [](A a, Uv uv) { join_seams(a, uv, [](std::int32_t) { return true; }); });
  to += derivatives_of("channel_derivatives_bilinear", [](A, Uv uv) { uv.rule = ChannelRule::kAll; });
  to += derivatives_of("channel_derivatives_of_none", [](A, Uv uv) { uv.rule = ChannelRule::kNone; });
  to += derivatives("channel_derivatives_of_next_corner", [](A, std::vector<double>& all, const Delivered&) {
    for (std::size_t t = 0; t + 12 <= all.size(); t += 12) std::rotate(&all[t], &all[t + 4], &all[t] + 12);
  });
  to += derivatives("channel_derivatives_by_parameter", [](A, std::vector<double>& all, const Delivered&) {
    const std::vector<double> before = all;
    for (std::size_t c = 0; 4 * c < all.size(); ++c) {
      std::copy_n(&before[4 * c], 2, &all[2 * c]);
      std::copy_n(&before[4 * c + 2], 2, &all[all.size() / 2 + 2 * c]);
    }
  });
  to += derivatives("channel_derivatives_of_chords", [](A a, std::vector<double>& all, const Delivered& out) {
    // Of the values at the corners, where the triangle has sides along both parameters.
    for (std::size_t t = 0; t < out.triangles.size(); ++t) {
      if (a.is_polygon(static_cast<std::size_t>(out.triangle_face[t]))) continue;
      std::array<std::array<double, 2>, 3> at{};
      for (std::size_t k = 0; k < 3; ++k) {
        const Place p = out.place(out.triangles[t][k]);
        at[k] = {double(p.i) / p.denominator, double(p.j) / p.denominator};
      }
      const double ax = at[1][0] - at[0][0], ay = at[1][1] - at[0][1], bx = at[2][0] - at[0][0],
                   by = at[2][1] - at[0][1], det = ax * by - ay * bx;
      const double* v = &out.channel_values[6 * t];
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t c = 0; c < 2; ++c) {
          const double p = v[2 + c] - v[c], q = v[4 + c] - v[c];
          all[12 * t + 4 * k + c] = (p * by - q * ay) / det;
          all[12 * t + 4 * k + 2 + c] = (q * ax - p * bx) / det;
        }
    }
  });
  to += derivatives("channel_derivatives_nan", [](A, std::vector<double>& all, const Delivered&) {
    std::fill(all.end() - 12, all.end(), std::numeric_limits<double>::quiet_NaN());
  });
  to += derivatives("channel_derivatives_unwritten", [](A, std::vector<double>& all, const Delivered&) {
    std::memset(&all.back(), 0xFF, sizeof(double));
  });
  to += derivatives("channel_derivatives_missing",
                    [](A, std::vector<double>& all, const Delivered&) { all.clear(); });
}

}  // namespace limitcheck::verify
