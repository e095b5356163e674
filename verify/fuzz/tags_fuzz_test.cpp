// SPDX-License-Identifier: MIT
// libFuzzer target: whatever the tags of an OBJ file, it is refused or gives a mesh without faults that is written
// and read as it is; and a repair ends in a mesh without faults that a second one leaves as it is.
#include <fuzzer/FuzzedDataProvider.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "data/error.h"
#include "data/io/write.h"
#include "data/validate.h"
#include "verify/repair/test_repair_properties.h"

using namespace limitcheck;

namespace {

// A strip of two quads and a triangle.
constexpr const char* kMesh =
    "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 3 1 1\nf 1 2 5 4\nf 2 3 6 5\nf 3 7 6\n";

std::string tag_from(FuzzedDataProvider& bytes) {
  const auto index = [&] { return " " + std::to_string(bytes.ConsumeIntegralInRange(-1, 7)); };
  const auto sharpness = [&]() -> std::string {
    if (bytes.ConsumeBool()) return " " + std::to_string(bytes.ConsumeIntegralInRange(-8, 96) / 8.0);
    return bytes.PickValueInArray<const char*>({" inf", " nan", " 23/10", " 1/0", " 1e39", " 1e-46", " x"});
  };
  switch (bytes.ConsumeIntegralInRange(0, 6)) {
    case 0:
      return "crease 2/1/0" + index() + index() + sharpness();
    case 1:
      return "corner 1/1/0" + index() + sharpness();
    case 2:
      return "hole 1/0/0" + index();
    case 3:
      return "interpolateboundary 1/0/0" + index();
    case 4:
      return bytes.PickValueInArray<const char*>(
          {"creasemethod 0/0/1 chaikin", "creasemethod 0/0/1 normal", "smoothtriangles 0/0/1 smooth",
           "facevaryinginterpolateboundary 1/0/0 1", "edgeedit 2/1/3 1 0 1 add value sharpness"});
    case 5:
      return "crease 4/2/0" + index() + index() + index() + index() + sharpness() + sharpness();
    default:
      return bytes.ConsumeRandomLengthString(24);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider bytes(data, size);
  const bool weld = bytes.ConsumeBool();
  const auto polygons = bytes.PickValueInArray(
      {data::Triangulation::kKeep, data::Triangulation::kFan, data::Triangulation::kShortestDiagonal});
  std::string text = kMesh;
  while (bytes.remaining_bytes() > 0) text += "t " + tag_from(bytes) + "\n";
  try {
    const data::io::PolygonSoup soup = data::io::read_obj(text, "tags.obj");
    const std::string broken = verify::broken_property(soup, {.weld = weld});
    if (!broken.empty()) {
      std::fprintf(stderr, "%s\n%s", broken.c_str(), text.c_str());
      std::abort();
    }
    const data::ControlMesh mesh = data::io::require_valid(soup, "tags.obj", {.polygons = polygons}).mesh;
    if (!data::validate(mesh).empty()) std::abort();
    const std::string written = data::mesh_content(mesh, data::FileFormat::kObj);
    const data::ControlMesh again = data::read_mesh(written, data::FileFormat::kObj, "again.obj");
    if (data::mesh_content(again, data::FileFormat::kObj) != written) std::abort();
  } catch (const data::InputError&) {
  }
  return 0;
}
