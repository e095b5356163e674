// SPDX-License-Identifier: MIT
#include "verify/files/read/tessellation_file.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "data/error.h"
#include "data/io/gltf.h"

namespace limitcheck::verify {

FileTessellation read_tessellation(const std::filesystem::path& file) {
  data::io::PolygonSoup soup =
      data::io::is_gltf(file) ? data::io::read_gltf(file) : data::io::read_soup(file);
  FileTessellation t;
  t.name = file.string();
  const auto vertices = static_cast<std::int64_t>(soup.positions.size());
  if (vertices == 0) throw data::InputError("MESH_EMPTY", t.name, 0, "no vertices");
  if (vertices > std::numeric_limits<std::int32_t>::max() ||
      soup.corners.size() > std::numeric_limits<std::int32_t>::max())
    throw data::InputError("MESH_TOO_LARGE", t.name, 0, "more vertices or corners than 32-bit indices name");
  t.positions = std::move(soup.positions);

  std::vector<std::pair<std::int32_t, std::int64_t>> pairs;  // vertex, normal
  std::vector<std::array<std::int64_t, 3>> given;            // normals of the corners of triangles
  const auto normal_at = [&](std::size_t at) {
    const std::int64_t normal = soup.corner_normals[at];
    return normal >= 0 && normal < static_cast<std::int64_t>(soup.normals.size()) ? normal : -1;
  };
  const auto with = [&](int components) {
    return std::find_if(soup.channels.begin(), soup.channels.end(),
                        [&](const auto& c) { return c.components == components; });
  };
  const auto channel = with(2) != soup.channels.end() ? with(2) : with(3);
  const bool has_texture = channel != soup.channels.end() && channel->corners.size() == soup.corners.size();
  if (has_texture)
    for (std::size_t k = 0; k + 1 < channel->values.size();
         k += static_cast<std::size_t>(channel->components))
      t.texture.push_back({channel->values[k], channel->values[k + 1]});
  const auto texture_at = [&](std::size_t at) {
    const std::int64_t index = channel->corners[at];
    return index >= 0 && index < static_cast<std::int64_t>(t.texture.size())
               ? static_cast<std::int32_t>(index)
               : -1;
  };
  t.used.assign(t.positions.size(), false);
  std::size_t begin = 0;
  for (std::size_t i = 0; i < soup.polygon_end.size(); begin = soup.polygon_end[i++]) {
    const std::size_t n = soup.polygon_end[i] - begin;
    const std::int64_t* corner = soup.corners.data() + begin;
    ++t.polygons;
    if (n < 3 || std::any_of(corner, corner + n, [&](std::int64_t v) { return v < 0 || v >= vertices; })) {
      ++t.left_out;
      continue;
    }
    t.quads += n == 4;
    t.larger += n > 4;
    for (std::size_t k = 0; k < n; ++k) {
      t.used[corner[k]] = true;
      if (soup.corner_normals.empty()) continue;
      if (const std::int64_t normal = normal_at(begin + k); normal >= 0)
        pairs.emplace_back(static_cast<std::int32_t>(corner[k]), normal);
    }
    for (std::size_t k = 1; k + 1 < n; ++k) {
      t.triangles.push_back({static_cast<std::int32_t>(corner[0]), static_cast<std::int32_t>(corner[k]),
                             static_cast<std::int32_t>(corner[k + 1])});
      t.polygon.push_back(static_cast<std::int64_t>(i));
      if (has_texture)
        t.corner_texture.push_back({texture_at(begin), texture_at(begin + k), texture_at(begin + k + 1)});
      if (!soup.corner_normals.empty())
        given.push_back({normal_at(begin), normal_at(begin + k), normal_at(begin + k + 1)});
    }
  }
  if (t.triangles.empty()) t.used.assign(t.positions.size(), true);  // a cloud of points

  if (soup.corner_normals.empty() && soup.normals.size() == t.positions.size()) {
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(vertices); ++v)
      t.normals.push_back({v, soup.normals[v]});
  } else {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for (const auto& [vertex, normal] : pairs) t.normals.push_back({vertex, soup.normals[normal]});
    for (std::size_t k = 0; k < given.size(); ++k) {
      auto& which = t.corner_normals.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        const std::pair key(t.triangles[k][c], given[k][c]);
        const auto at = std::lower_bound(pairs.begin(), pairs.end(), key);
        which[c] = at != pairs.end() && *at == key ? static_cast<std::int32_t>(at - pairs.begin()) : -1;
      }
    }
  }
  return t;
}

}  // namespace limitcheck::verify
