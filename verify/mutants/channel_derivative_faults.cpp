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
Change derivatives(const char* name, const char* description,
                   std::function<void(A, std::vector<double>&, const Delivered&)> what,
                   std::function<bool(A)> shows = {}, const char* check = "channel-derivatives") {
  return of_channels(deliver(name, description, check,
                             [what = std::move(what)](A a, D out) {
                               if (out.channel_derivatives.empty()) nowhere("derivative");
                               what(a, out.channel_derivatives, out);
                             }),
                     std::move(shows));
}
// Each four numbers.
Change each_derivative(const char* name, const char* description,
                       std::function<void(A, std::int32_t face, double* d)> what,
                       std::function<bool(A)> shows = {}) {
  return derivatives(
      name, description,
      [what](A a, std::vector<double>& all, const Delivered& out) {
        for (std::size_t c = 0; 4 * c < all.size(); ++c) what(a, out.triangle_face[c / 3], &all[4 * c]);
      },
      std::move(shows));
}
// Those of another channel on the same mesh.
Change derivatives_of(const char* name, const char* description, std::function<void(A, Uv)> other) {
  const auto change = [other](A a) { return [other, &a](Mesh m) { other(a, m.channels.front()); }; };
  return derivatives(
      name, description,
      [change](A a, std::vector<double>& all, const Delivered&) {
        all = again(a, change(a)).channel_derivatives;
      },
      [change](A a) { return changes(a, change(a)); });
}

}  // namespace

std::vector<Change> faults_of_channel_derivatives() {
  const auto deep = [](A a) { return a.deepest > 0; };
  return {
      each_derivative("channel_derivatives_swapped", "derivatives by u and by v are exchanged",
                      [](A, std::int32_t, double* d) { std::swap_ranges(d, d + 2, d + 2); }),
      each_derivative("channel_derivatives_transposed", "the components are exchanged in derivatives",
                      [](A, std::int32_t, double* d) { std::swap(d[0], d[1]), std::swap(d[2], d[3]); }),
      each_derivative("channel_derivatives_first_component", "of the first component alone",
                      [](A, std::int32_t, double* d) { d[1] = d[3] = 0; }),
      each_derivative("channel_derivatives_negated", "derivatives by v point the other way",
                      [](A, std::int32_t, double* d) { d[2] = -d[2], d[3] = -d[3]; }),
      each_derivative("channel_derivatives_by_one_parameter", "derivatives by u stand for both",
                      [](A, std::int32_t, double* d) { std::copy_n(d, 2, d + 2); }),
      each_derivative(
          "channel_derivatives_of_level", "derivatives by the parameters of the smallest quads",
          [](A a, std::int32_t f, double* d) {
            for (int k = 0; k < 4; ++k) d[k] = std::ldexp(d[k], -a.depth[static_cast<std::size_t>(f)]);
          },
          deep),
      each_derivative("channel_derivatives_of_unit_length", "derivatives are scaled to unit length",
                      [](A, std::int32_t, double* d) {
                        for (int by = 0; by < 4; by += 2)
                          if (const double size = std::hypot(d[by], d[by + 1]); size > 0)
                            d[by] /= size, d[by + 1] /= size;
                      }),
      on(Change::On::kQuads,
         each_derivative(
             "channel_derivatives_of_polygons", "derivatives of faces that are no quads are twice as large",
             [](A a, std::int32_t f, double* d) {
               for (int k = 0; k < 4 && a.is_polygon(static_cast<std::size_t>(f)); ++k) d[k] *= 2;
             },
             [](A a) {
               bool any = false;
               for (std::size_t f = 0; f < a.mesh.faces.size(); ++f) any = any || a.is_polygon(f);
               return any && a.deepest > 0;
             })),
      derivatives_of("channel_derivatives_without_seams", "derivatives of one value for each vertex",
                     [](A a, Uv uv) { join_seams(a, uv, [](std::int32_t) { return true; }); }),
      derivatives_of("channel_derivatives_bilinear", "derivatives of the rule all",
                     [](A, Uv uv) { uv.rule = ChannelRule::kAll; }),
      derivatives_of("channel_derivatives_of_none", "derivatives of the rule none",
                     [](A, Uv uv) { uv.rule = ChannelRule::kNone; }),
      derivatives(
          "channel_derivatives_of_next_corner", "derivatives are those of the next corner",
          [](A, std::vector<double>& all, const Delivered&) {
            for (std::size_t t = 0; t + 12 <= all.size(); t += 12)
              std::rotate(&all[t], &all[t + 4], &all[t] + 12);
          },
          deep),
      derivatives("channel_derivatives_by_parameter", "all derivatives by u come first",
                  [](A, std::vector<double>& all, const Delivered&) {
                    const std::vector<double> before = all;
                    for (std::size_t c = 0; 4 * c < all.size(); ++c) {
                      std::copy_n(&before[4 * c], 2, &all[2 * c]);
                      std::copy_n(&before[4 * c + 2], 2, &all[all.size() / 2 + 2 * c]);
                    }
                  }),
      derivatives("channel_derivatives_of_chords", "derivatives along the triangle's sides",
                  [](A a, std::vector<double>& all, const Delivered& out) {
                    // Of the values at the corners, where the triangle has sides along both parameters.
                    for (std::size_t t = 0; t < out.triangles.size(); ++t) {
                      if (a.is_polygon(static_cast<std::size_t>(out.triangle_face[t]))) continue;
                      std::array<std::array<double, 2>, 3> at{};
                      for (std::size_t k = 0; k < 3; ++k) {
                        const Place p = out.place(out.triangles[t][k]);
                        at[k] = {double(p.i) / p.denominator, double(p.j) / p.denominator};
                      }
                      const double ax = at[1][0] - at[0][0], ay = at[1][1] - at[0][1],
                                   bx = at[2][0] - at[0][0], by = at[2][1] - at[0][1],
                                   det = ax * by - ay * bx;
                      const double* v = &out.channel_values[6 * t];
                      for (std::size_t k = 0; k < 3; ++k)
                        for (std::size_t c = 0; c < 2; ++c) {
                          const double p = v[2 + c] - v[c], q = v[4 + c] - v[c];
                          all[12 * t + 4 * k + c] = (p * by - q * ay) / det;
                          all[12 * t + 4 * k + 2 + c] = (q * ax - p * bx) / det;
                        }
                    }
                  }),
      derivatives(
          "channel_derivatives_nan", "the derivatives at one triangle are NaN",
          [](A, std::vector<double>& all, const Delivered&) {
            std::fill(all.end() - 12, all.end(), std::numeric_limits<double>::quiet_NaN());
          },
          deep),
      derivatives(
          "channel_derivatives_unwritten", "the last derivative is not written",
          [](A, std::vector<double>& all, const Delivered&) {
            std::memset(&all.back(), 0xFF, sizeof(double));
          },
          {}, "written"),
      derivatives(
          "channel_derivatives_missing", "derivatives are promised and not delivered",
          [](A, std::vector<double>& all, const Delivered&) { all.clear(); }, {}, "written"),
  };
}

}  // namespace limitcheck::verify
