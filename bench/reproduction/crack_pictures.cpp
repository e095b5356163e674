// SPDX-License-Identifier: MIT
// Pictures of cracks and of what repairs them.                                    [mueller2000, Figs. 6-8]
#include <algorithm>

#include "bench/reproduction/studio.h"
#include "data/shapes.h"

namespace limitcheck::bench {

namespace {

fast::CrackOptions cracks(fast::Repair repair, fast::FanCentre centre = fast::FanCentre::kLimit) {
  fast::CrackOptions options;
  options.repair = repair;
  options.centre = centre;
  return options;
}

}  // namespace

Image cracks_close_up(fast::Repair repair) {
  Studio studio = bumpy(200);
  fast::Camera close = camera_at(58, 2.3);
  close.target = {.45, .2, .35};
  fast::DepthOptions unequal;
  unequal.strategy = fast::Strategy::kCustom;
  unequal.custom = [](std::int32_t face) { return face % 3 == 0 ? 4 : 1; };
  Appearance appearance = by_depth(true);
  appearance.backfaces = true;  // what shows through a crack is the inside, in red
  return studio.shot(studio.frame(unequal, close, cracks(repair)), close, appearance);
}

Image cracks_and_repair() {
  return beside({cracks_close_up(fast::Repair::kNone), cracks_close_up(fast::Repair::kFan)});
}

Image fan_centres() {
  Studio studio(data::icosahedron());
  // Two faces of depth 1, which become a pair, amid depth 3: two fans.
  const data::Faces& faces = studio.mesh().faces;
  const auto common = [&](std::int32_t face) {
    int corners = 0;
    for (const std::int32_t v : faces[face])
      corners += static_cast<int>(std::count(faces[0].begin(), faces[0].end(), v));
    return corners;
  };
  std::int32_t other = 1;
  while (common(other) != 2) ++other;
  fast::DepthOptions one;
  one.strategy = fast::Strategy::kCustom;
  one.custom = [other](std::int32_t face) { return face == 0 || face == other ? 1 : 3; };
  fast::Point3 middle{};
  for (const std::int32_t v : faces[0])
    middle = middle + (1. / 3) * fast::to_point(studio.mesh().positions[v]);
  const fast::Point3 outward = (1 / length(middle)) * middle;
  const fast::Point3 side = [&] {
    const fast::Point3 s = cross(fast::Point3{0, 1, 0}, outward);
    return (1 / length(s)) * s;
  }();
  fast::Camera near = camera_at(0, 1);
  near.target = .85 * middle;
  near.eye = near.target + .9 * outward + .9 * side;
  const auto with = [&](fast::FanCentre centre) {
    Appearance appearance = by_depth(true);
    appearance.flat = true;
    return studio.shot(studio.frame(one, near, cracks(fast::Repair::kFan, centre)), near, appearance);
  };
  return beside({with(fast::FanCentre::kFlatLimit), with(fast::FanCentre::kLimit)});
}

}  // namespace limitcheck::bench
