// SPDX-License-Identifier: MIT
// The recursive subdivider of the paper's section 4 in double, with Loop's rules (reference/loop/recursion.h) or
// Catmull and Clark's (reference/catmull_clark/recursion.h). It delivers single triangles and quads and rounds
// differently in each. Of the values of one point the first in the order of their bits is taken, so that
// neither the triangles of a face nor faces of one depth have cracks of one ulp. Faces share no vertices. A
// quad is cut along its diagonal from (0, 0). [C18, C21]
//
//   options   weights=loop|warren (default loop)
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "reference/catmull_clark/recursion.h"
#include "reference/loop/recursion.h"
#include "reference/loop/refine.h"
#include "reference/surface/channel.h"
#include "verify/peers/evaluated_faces.h"
#include "verify/subject/adapter.h"
#include "verify/subject/face_domain.h"
#include "verify/subject/lattice.h"
#include "verify/subject/registry.h"
#include "verify/subject/weights_option.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;
using Loop = reference::NaiveSubdivider<double>;
using CatmullClark = reference::catmull_clark::NaiveSubdivider<double>;
using Vec3 = reference::Vec3<double>;

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

struct Corner {
  Vec3 position, normal;
  FaceDomain::Point at;
};

// Puts the lesser of both, by their bits, in place of the first.
void agree(Vec3& a, const Vec3& b) {
  using Bits = std::array<std::uint64_t, 3>;
  if (std::bit_cast<Bits>(b) < std::bit_cast<Bits>(a)) a = b;
}

// The vertices, one for each lattice point, and the triangles of one face.
class Face {
 public:
  std::vector<Corner> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices into vertices

  Face(FaceDomain domain, int depth)
      : domain_(domain), n_(std::int64_t{1} << depth), vertex_(domain.point_count(n_), kNone) {}

  void subdivide(const Loop& subdivider, std::size_t face, int depth) {
    subdivider.tessellate(face, depth, [&](const reference::LeafTriangle<double>& leaf) {
      triangles.push_back({add(leaf[0]), add(leaf[1]), add(leaf[2])});
    });
  }
  void subdivide(const CatmullClark& subdivider, std::size_t face, int depth) {
    using Leaf = reference::catmull_clark::LeafQuad<double>;
    const bool corners_only = domain_.parts() > 1 && depth == 0;
    for (int part = 0; part < domain_.parts(); ++part)
      subdivider.tessellate(face, static_cast<std::size_t>(part), corners_only ? 1 : depth,
                            [&](const Leaf& leaf) {
                              if (corners_only) {  // of its first quad
                                add(leaf[0], part);
                                return;
                              }
                              const std::array at{add(leaf[0], part), add(leaf[1], part), add(leaf[2], part),
                                                  add(leaf[3], part)};
                              triangles.push_back({at[0], at[1], at[2]});
                              triangles.push_back({at[0], at[2], at[3]});
                            });
    for (std::uint32_t k = 1; corners_only && k + 1 < vertices.size(); ++k)
      triangles.push_back({0, k, k + 1});
  }

 private:
  std::uint32_t add(const auto& leaf, std::int32_t part = 0) {
    const Corner corner{leaf.position, leaf.normal, domain_.canonical({leaf.i, leaf.j, part}, n_)};
    std::uint32_t& at = vertex_[domain_.number(corner.at, n_)];
    if (at == kNone) {
      at = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(corner);
    }
    agree(vertices[at].position, corner.position);
    agree(vertices[at].normal, corner.normal);
    return at;
  }

  FaceDomain domain_;
  std::int64_t n_;
  std::vector<std::uint32_t> vertex_;  // of each lattice point
};

class NaiveSubject {
 public:
  static lc_capabilities capabilities(Options& options, lc_scheme) {
    lc_capabilities result{LC_FLOAT64, weights_option(options), LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 10, 1, 1,
                           1};
    result.sharp =
        LC_SHARP_CREASES | LC_SHARP_SEMI | LC_SHARP_CHAIKIN | LC_SHARP_CORNERS | LC_SHARP_SMOOTH_TRIANGLES;
    result.channel_rules = kAllChannelRules;
    result.channel_derivatives = 1;
    return result;
  }

  NaiveSubject(const lc_mesh& mesh, Options& options)
      : lent_(mesh),
        mesh_(control_mesh(mesh)),
        scheme_(scheme_of(mesh.scheme)),
        subdivider_(make_subdivider(mesh_, scheme_, family(weights_option(options)))) {}

  void tessellate(const lc_request& request, lc_tessellation& out) {
    const auto count = static_cast<std::int64_t>(mesh_.faces.size());
    const std::span depth(request.face_depth, mesh_.faces.size());

    // The number of vertices of a face is known only when it is done, so all faces come first, then the
    // arrays.
    Faces faces(mesh_.faces.size());
    faces_in_parallel(count, request.threads, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t f = begin; f < end; ++f) {
        const auto k = static_cast<std::size_t>(f);
        if (depth[k] < 0) continue;
        faces[k] = std::make_unique<Face>(domain(k), depth[k]);
        std::visit([&](const auto& subdivider) { faces[k]->subdivide(subdivider, k, depth[k]); },
                   subdivider_);
      }
    });
    agree_on_borders(faces, depth);
    DeliveredArrays all;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      if (faces[k] == nullptr) continue;
      const auto base = static_cast<std::uint32_t>(all.positions.size());
      for (const Corner& corner : faces[k]->vertices) {
        const Place p = place(k, corner.at, depth[k]);
        all.add_vertex(corner.position, corner.normal, {p.face, p.i, p.j, p.denominator}, p.corner);
      }
      for (const auto& [a, b, c] : faces[k]->triangles)
        all.add_triangle({base + a, base + b, base + c}, static_cast<std::int32_t>(k));
      if (mesh_.channels.empty()) faces[k].reset();
    }
    all.hand_over<double>(request, out, /*with_normals=*/true,
                          /*with_corners=*/scheme_ == data::Scheme::kCatmullClark);
    if (mesh_.channels.empty()) return;
    double* to = allocate_channels<double>(request, lent_, out);
    double* derivatives =
        allocate_channels<double>(request, lent_, out, &lc_tessellation::channel_derivatives);
    for (const data::Channel& channel : mesh_.channels) {
      put_channel(channel, faces, depth, request.threads, to, derivatives);
      to += 3 * std::ssize(all.triangles) * channel.components;
      derivatives += 6 * std::ssize(all.triangles) * channel.components;
    }
  }

 private:
  using Subdivider = std::variant<Loop, CatmullClark>;
  static Subdivider make_subdivider(const data::ControlMesh& mesh, data::Scheme scheme,
                                    reference::Weights weights) {
    if (scheme == data::Scheme::kLoop) return Loop(mesh, weights);
    return CatmullClark(mesh.faces, reference::positions_of<double>(mesh), mesh.sharpness);
  }
  FaceDomain domain(std::size_t face) const { return {scheme_, static_cast<int>(mesh_.faces[face].size())}; }

  using Faces = std::vector<std::unique_ptr<Face>>;
  using FaceDepths = std::span<const std::int32_t>;

  Place place(std::size_t face, const FaceDomain::Point& at, int depth) const {
    const std::int64_t denominator = domain(face).denominator(std::int64_t{1} << depth);
    return {static_cast<std::int32_t>(face), static_cast<std::uint32_t>(at.i),
            static_cast<std::uint32_t>(at.j),
            static_cast<std::uint32_t>(std::max<std::int64_t>(1, denominator)), at.part};
  }

  // The vertices that lie on edges of a mesh, which has faces as this one does.
  struct OnEdge {
    Lattice::Id point;
    Sides::Id side;
    std::size_t face, vertex;
  };
  std::vector<OnEdge> on_edges(const data::ControlMesh& mesh, const Faces& faces, FaceDepths depth) const {
    std::int32_t deepest = 0;
    for (const std::int32_t d : depth) deepest = std::max(deepest, d);
    const Lattice lattice(mesh, scheme_, deepest);
    const Sides sides(lattice);
    std::vector<OnEdge> all;
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (std::size_t v = 0; faces[f] != nullptr && v < faces[f]->vertices.size(); ++v)
        if (const Lattice::Id id = lattice.id(place(f, faces[f]->vertices[v].at, depth[f]));
            lattice.is_shared(id))
          all.push_back({id, sides.of(id, static_cast<std::int32_t>(f)), f, v});
    return all;
  }

  // Position and normal of each point on control edges, whatever the order of faces; the normal of each side of an edge
  // that stays sharp.
  void agree_on_borders(Faces& faces, FaceDepths depth) const {
    const std::vector<OnEdge> shared = on_edges(mesh_, faces, depth);
    std::unordered_map<Lattice::Id, Vec3> position, normal;
    for (const auto& [point, side, f, v] : shared) {
      const Corner& corner = faces[f]->vertices[v];
      agree(position.try_emplace(point, corner.position).first->second, corner.position);
      agree(normal.try_emplace(side, corner.normal).first->second, corner.normal);
    }
    for (const auto& [point, side, f, v] : shared) {
      faces[f]->vertices[v].position = position.at(point);
      faces[f]->vertices[v].normal = normal.at(side);
    }
  }

  // Of each corner of each triangle; of the values of one point on one side of a seam the first in the order of their
  // bits is taken, as of positions. Channels are evaluated by the reference, three components at a time.
  void put_channel(const data::Channel& channel, const Faces& faces, FaceDepths depth, int threads,
                   double* to, double* derivatives) {
    data::ControlMesh cut;
    cut.faces = reference::faces_of_cut(mesh_, channel);
    cut.positions.resize(cut.faces.corners().size());  // more than there are
    const std::vector<OnEdge> shared = on_edges(cut, faces, depth);
    const data::ChannelRule rule = channel.rule.value_or(data::kUsualChannelRule);
    for (int first = 0; first < channel.components; first += 3) {
      const int count = std::min(3, channel.components - first);
      const reference::ChannelSurface& surface =
          channels_.try_emplace({&channel, first}, mesh_, channel.some(first, count), rule, scheme_)
              .first->second;
      const auto evaluate = [&](std::size_t f, const FaceDomain::Point& at) {
        const Place p = place(f, at, depth[f]);
        const double n = p.denominator;
        return surface.evaluate(p.face, p.corner, p.i / n, p.j / n);
      };
      std::vector<std::vector<Vec3>> values(faces.size());
      std::vector<std::vector<std::array<Vec3, 2>>> slopes(faces.size());
      faces_in_parallel(std::ssize(faces), threads, [&](std::int64_t begin, std::int64_t end) {
        for (auto f = static_cast<std::size_t>(begin); f < static_cast<std::size_t>(end); ++f)
          for (std::size_t v = 0; faces[f] != nullptr && v < faces[f]->vertices.size(); ++v) {
            const auto at = evaluate(f, faces[f]->vertices[v].at);
            values[f].push_back(at.position);
            slopes[f].push_back({at.d1, at.d2});
          }
      });
      std::unordered_map<Lattice::Id, Vec3> agreed;
      for (const auto& [point, side, f, v] : shared)
        agree(agreed.try_emplace(point, values[f][v]).first->second, values[f][v]);
      for (const auto& [point, side, f, v] : shared) values[f][v] = agreed.at(point);
      std::size_t written = 0;
      const auto put = [&](const Vec3& value, double* place) {
        const std::array all{value.x, value.y, value.z};
        std::copy_n(all.begin(), count, place + first);
      };
      const auto components = static_cast<std::size_t>(channel.components);
      for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t t = 0; faces[f] != nullptr && t < faces[f]->triangles.size(); ++t) {
          const std::array<std::uint32_t, 3>& corners = faces[f]->triangles[t];
          // Derivatives are by the parameters of the quad in which the triangle lies.
          std::array<FaceDomain::Point, 3> at;
          for (std::size_t k = 0; k < 3; ++k) at[k] = faces[f]->vertices[corners[k]].at;
          domain(f).share_part(at, std::int64_t{1} << depth[f]);
          for (std::size_t k = 0; k < 3; ++k, written += components) {
            const std::uint32_t v = corners[k];
            put(values[f][v], to + written);
            std::array<Vec3, 2> slope = slopes[f][v];
            if (at[k].part != faces[f]->vertices[v].at.part) {
              const auto there = evaluate(f, at[k]);
              slope = {there.d1, there.d2};
            }
            put(slope[0], derivatives + 2 * written);
            put(slope[1], derivatives + 2 * written + components);
          }
        }
    }
  }

  const lc_mesh lent_;
  const data::ControlMesh mesh_;
  const data::Scheme scheme_;
  const Subdivider subdivider_;
  // Of a channel from a component on, made when first asked for.
  std::map<std::pair<const data::Channel*, int>, const reference::ChannelSurface> channels_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_naive() {
  static const lc_subject subject = make_subject<NaiveSubject>(
      "naive", "our own recursive subdivider, as the paper's section 4 lists it, in double; both schemes",
      "weights=loop|warren (default loop)");
  return &subject;
}
