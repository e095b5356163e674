// SPDX-License-Identifier: MIT
#include "reference/mesh/topology.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "data/error.h"

namespace limitcheck::reference {
namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw data::ArgumentError("control mesh: " + why);
}

void check_faces(std::size_t vertex_count, const data::Faces& faces) {
  std::vector<std::int32_t> last_face(vertex_count, -1);  // of those that name the vertex
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto refuse_face = [f](const std::string& why) { refuse("face " + std::to_string(f) + why); };
    if (faces[f].size() < 3) refuse_face(" has " + std::to_string(faces[f].size()) + " corners");
    for (const std::int32_t v : faces[f])
      if (v < 0 || static_cast<std::size_t>(v) >= vertex_count)
        refuse_face(" names vertex " + std::to_string(v));
    for (const std::int32_t v : faces[f]) {
      const auto face = static_cast<std::int32_t>(f);
      if (last_face[v] == face) refuse_face(" repeats a vertex");
      last_face[v] = face;
    }
  }
}

/// The numbers 0 .. count - 1 in groups of one key (below `keys`) each, rising within a group.
struct Groups {
  template <class Key>
  Groups(std::size_t keys, std::size_t count, Key key) : start(keys + 1, 0), members(count) {
    for (std::size_t i = 0; i < count; ++i) ++start[key(i) + 1];
    for (std::size_t k = 0; k < keys; ++k) start[k + 1] += start[k];
    auto fill = start;
    for (std::size_t i = 0; i < count; ++i) members[fill[key(i)]++] = static_cast<std::int32_t>(i);
  }
  std::span<std::int32_t> operator[](std::size_t key) {
    return std::span(members).subspan(start[key], start[key + 1] - start[key]);
  }

  std::vector<std::size_t> start;
  std::vector<std::int32_t> members;
};

}  // namespace

/// The sides of all faces. Side s leaves corner s towards the next corner of the face.
struct Topology::Sides {
  explicit Sides(const data::Faces& all) : faces(all) {
    face.reserve(all.corners().size());
    end.reserve(all.corners().size());
    for (std::size_t f = 0; f < all.size(); ++f) {
      const auto corners = all[f];
      face.insert(face.end(), corners.size(), static_cast<std::int32_t>(f));
      end.insert(end.end(), corners.begin() + 1, corners.end());
      end.push_back(corners[0]);
    }
  }

  std::size_t count() const { return face.size(); }
  std::size_t previous(std::size_t s) const {
    return (s == faces.first_corner(face[s]) ? faces.first_corner(face[s] + 1) : s) - 1;
  }
  std::int32_t from(std::size_t s) const { return faces.corners()[s]; }
  std::int32_t to(std::size_t s) const { return end[s]; }
  std::int32_t low(std::size_t s) const { return std::min(from(s), to(s)); }
  std::int32_t high(std::size_t s) const { return std::max(from(s), to(s)); }

  const data::Faces& faces;
  std::vector<std::int32_t> face, end;  ///< of each side: its face, and the vertex that it leads to
  std::vector<std::int32_t> across;     ///< the side of the other face at the same edge, or -1
};

Topology::Topology(std::size_t vertex_count, data::Faces faces) : faces_(std::move(faces)) {
  check_faces(vertex_count, faces_);
  Sides sides(faces_);
  join(sides, vertex_count);
  order_sectors(sides, vertex_count);
}

/// Makes an edge of the one or two sides that join the same vertices.
void Topology::join(Sides& sides, std::size_t vertex_count) {
  edge_.resize(sides.count());
  sides.across.assign(sides.count(), -1);
  Groups at_low(vertex_count, sides.count(), [&](std::size_t s) { return sides.low(s); });
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const auto group = at_low[v];
    std::sort(group.begin(), group.end(), [&](std::int32_t s, std::int32_t t) {
      return std::tuple(sides.high(s), s) < std::tuple(sides.high(t), t);
    });
    for (std::size_t i = 0; i < group.size();) {
      const std::int32_t s = group[i], high = sides.high(s);
      const auto same_edge = [&](std::size_t at) {
        return at < group.size() && sides.high(group[at]) == high;
      };
      Edge edge{sides.from(s), sides.to(s), sides.face[s], -1};
      edge_[s] = static_cast<std::int32_t>(edges_.size());
      if (same_edge(++i)) {
        const std::int32_t t = group[i];
        if (sides.from(t) != edge.b)
          refuse("faces " + std::to_string(sides.face[s]) + " and " + std::to_string(sides.face[t]) +
                 " clash in orientation");
        edge.right_face = sides.face[t];
        edge_[t] = edge_[s];
        sides.across[s] = t;
        sides.across[t] = s;
        ++i;
      }
      if (same_edge(i))
        refuse("edge " + std::to_string(v) + "-" + std::to_string(high) + " has more than two faces");
      edges_.push_back(edge);
    }
  }
}

/// Walks round every vertex, counter-clockwise: over the side that comes back to it into the next face.
void Topology::order_sectors(const Sides& sides, std::size_t vertex_count) {
  ring_index_.resize(sides.count());
  ring_start_.assign(1, 0);
  const auto add = [&](std::int32_t neighbour, std::int32_t edge, std::int32_t face) {
    ring_.push_back(neighbour);
    ring_edges_.push_back(edge);
    ring_faces_.push_back(face);
  };
  Groups leaving(vertex_count, sides.count(), [&](std::size_t s) { return sides.from(s); });
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const auto group = leaving[v];
    // An open sector begins with the side that leaves along the boundary.
    const auto first =
        std::find_if(group.begin(), group.end(), [&](std::int32_t s) { return sides.across[s] < 0; });
    const bool closed = first == group.end();
    std::size_t walked = 0;
    std::int32_t s = group.empty() ? -1 : closed ? group.front() : *first;
    for (const std::int32_t begin = s; s >= 0 && (walked == 0 || s != begin);) {
      ring_index_[s] = static_cast<std::int32_t>(walked++);
      add(sides.to(s), edge_[s], sides.face[s]);
      const std::size_t back = sides.previous(s);
      s = sides.across[back];
      if (s < 0) add(sides.from(back), edge_[back], -1);
    }
    if (walked != group.size()) refuse("vertex " + std::to_string(v) + " joins two fans of faces");
    if (closed && walked > 0 && walked < 3)
      refuse("interior vertex " + std::to_string(v) + " has valence " + std::to_string(walked));
    ring_start_.push_back(ring_.size());
  }
}

}  // namespace limitcheck::reference
