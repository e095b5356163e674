// SPDX-License-Identifier: MIT
// The limit surfaces that an audit's witnesses lie on, for the report's view in three dimensions.
#include <stdexcept>

#include "bench/reproduction/base64.h"
#include "bench/reproduction/reproduction.h"
#include "bench/reproduction/scene.h"
#include "data/generators/named_mesh.h"
#include "data/scheme.h"
#include "fast/window/tessellator.h"

namespace limitcheck::bench {

nlohmann::ordered_json shapes(const std::vector<std::string>& names) {
  using Json = nlohmann::ordered_json;
  constexpr std::size_t kTriangles = 6000;  // enough to look round, few enough for a page of many
  Json list = Json::object();
  for (const std::string& name : names) {
    try {
      const data::ControlMesh mesh = data::open_mesh(name).mesh;
      fast::DepthOptions depth;
      depth.strategy = fast::Strategy::kUniform;
      for (depth.depth = 0; depth.depth < 4 && mesh.faces.size() << 2 * (depth.depth + 1) <= kTriangles;)
        ++depth.depth;
      fast::TessellatorOptions options;
      options.scheme = data::natural_scheme(mesh);
      fast::Tessellator<float> engine(mesh, options);
      fast::IndexedMesh<float> out;
      engine.frame(depth, viewer(0), out);
      std::vector<std::uint32_t> corners;
      for (const auto& t : out.triangles) corners.insert(corners.end(), t.begin(), t.end());
      list[name] = {{"depth", depth.depth},
                    {"positions", base64(coordinates(out))},
                    {"triangles", base64(corners)},
                    {"face", base64(out.triangle_face)}};
    } catch (const std::exception& error) {
      list[name] = {{"error", error.what()}};
    }
  }
  return list;
}

}  // namespace limitcheck::bench
