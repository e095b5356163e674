// SPDX-License-Identifier: MIT
// The recursive subdivider of the paper's section 4 in double, with Loop's rules (reference/loop/naive.h) or
// Catmull and Clark's (reference/catmull_clark/naive.h). It delivers single triangles and quads and rounds
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
#include <set>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "reference/catmull_clark/naive.h"
#include "reference/loop/naive.h"
#include "reference/loop/refine.h"
#include "reference/mesh/sharpness.h"
#include "reference/surface/channel.h"
#include "verify/peers/evaluated_faces.h"
#include "verify/subject/adapter.h"
#include "verify/subject/face_domain.h"
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

// A point on a control edge: its ends, the smaller number first, and the way from there in 2^-31 of it. A
// control vertex is both ends of its edge.
using BorderPoint = std::array<std::int64_t, 3>;

// Sets `point` and returns the side of the face on which it lies, or -1 for a point inside.
int on_border(std::span<const std::int32_t> face, FaceDomain domain, const Corner& corner, int depth,
              BorderPoint& point) {
  const std::int64_t n = std::int64_t{1} << depth, unit = std::int64_t{1} << (31 - depth);
  const auto place = domain.side_of(corner.at, n);
  if (!place) return -1;
  std::int64_t a = face[place->side], b = face[domain.next(place->side)], way = place->along;
  if (way == 0) b = a;
  if (a > b) std::swap(a, b), way = n - way;
  point = {a, b, way * unit};
  return place->side;
}

// Which faces have a common normal at a point of a control edge: on an edge that stays sharp there is one for
// each side, at its ends one for each sector between such edges.
class Sides {
 public:
  explicit Sides(const data::ControlMesh& mesh) {
    if (mesh.sharpness.empty()) return;
    const reference::Topology topology(mesh.positions.size(), mesh.faces);
    cut_ = reference::Sharpness(topology, mesh.sharpness).cut(topology).faces;
    for (const data::SharpEdge& e : mesh.sharpness.edges)
      if (e.sharpness >= data::kInfiniteSharpness) edges_.insert(std::minmax(e.a, e.b));
  }
  // The same number in all faces that do.
  //   corner   of the face, where the point is a corner
  std::int64_t number(const BorderPoint& point, std::size_t face, int corner) const {
    const std::int64_t a = point[0], b = point[1];
    if (cut_.size() > 0 && a == b) return cut_[face][static_cast<std::size_t>(corner)];
    const bool sharp = edges_.count({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)}) > 0;
    return sharp ? static_cast<std::int64_t>(face) : -1;
  }

 private:
  data::Faces cut_;  // the faces with a copy of each vertex for each of its sectors
  std::set<std::pair<std::int32_t, std::int32_t>> edges_;
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
        subdivider_(make_subdivider(mesh_, scheme_, family(weights_option(options)))),
        sides_(mesh_) {}

  void tessellate(const lc_request& request, lc_tessellation& out) {
    const auto count = static_cast<std::int64_t>(mesh_.faces.size());
    const std::span depth(request.face_depth, mesh_.faces.size());

    // The number of vertices of a face is known only when it is done, so all faces come first, then the
    // arrays.
    std::vector<std::unique_ptr<Face>> faces(mesh_.faces.size());
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
      const auto face = static_cast<std::int32_t>(k);
      const auto base = static_cast<std::uint32_t>(all.positions.size());
      const auto denominator = static_cast<std::uint32_t>(
          std::max<std::int64_t>(1, domain(k).denominator(std::int64_t{1} << depth[k])));
      for (const Corner& corner : faces[k]->vertices)
        all.add_vertex(corner.position, corner.normal,
                       {face, static_cast<std::uint32_t>(corner.at.i),
                        static_cast<std::uint32_t>(corner.at.j), denominator},
                       corner.at.part);
      for (const auto& [a, b, c] : faces[k]->triangles)
        all.add_triangle({base + a, base + b, base + c}, face);
      if (mesh_.channels.empty()) faces[k].reset();
    }
    all.hand_over<double>(request, out, /*with_normals=*/true,
                          /*with_corners=*/scheme_ == data::Scheme::kCatmullClark);
    if (mesh_.channels.empty()) return;
    double* to = allocate_channels<double>(request, lent_, out);
    double* derivatives =
        allocate_channels<double>(request, lent_, out, &lc_tessellation::channel_derivatives);
    for (const data::Channel& channel : mesh_.channels) {
      put_channel(channel, faces, depth, to, derivatives);
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

  // Position and normal of each point on control edges, whatever the order of faces.
  void agree_on_borders(std::vector<std::unique_ptr<Face>>& faces,
                        std::span<const std::int32_t> depth) const {
    const auto each = [&](const auto& body) {
      BorderPoint point{};
      for (std::size_t f = 0; f < faces.size(); ++f)
        if (faces[f] != nullptr)
          for (Corner& corner : faces[f]->vertices)
            if (const int side = on_border(mesh_.faces[f], domain(f), corner, depth[f], point); side >= 0)
              body(point, sides_.number(point, f, side), corner);
    };
    std::map<BorderPoint, Vec3> position;
    std::map<std::pair<BorderPoint, std::int64_t>, Vec3> normal;
    each([&](const BorderPoint& point, std::int64_t side, const Corner& corner) {
      agree(position.try_emplace(point, corner.position).first->second, corner.position);
      agree(normal.try_emplace({point, side}, corner.normal).first->second, corner.normal);
    });
    each([&](const BorderPoint& point, std::int64_t side, Corner& corner) {
      corner.position = position.at(point);
      corner.normal = normal.at({point, side});
    });
  }

  // Of each corner of each triangle; of the values of one point on one side of a seam the first in the order of their
  // bits is taken, as of positions. Channels are evaluated by the reference, three components at a time.
  void put_channel(const data::Channel& channel, const std::vector<std::unique_ptr<Face>>& faces,
                   std::span<const std::int32_t> depth, double* to, double* derivatives) {
    const data::Faces cut = reference::faces_of_cut(mesh_, channel);
    const data::ChannelRule rule = channel.rule.value_or(data::kUsualChannelRule);
    for (int first = 0; first < channel.components; first += 3) {
      const int count = std::min(3, channel.components - first);
      const reference::ChannelSurface& surface =
          channels_.try_emplace({&channel, first}, mesh_, channel.some(first, count), rule, scheme_)
              .first->second;
      const auto evaluate = [&](std::size_t f, const FaceDomain::Point& at) {
        const double n =
            std::max(1., static_cast<double>(domain(f).denominator(std::int64_t{1} << depth[f])));
        return surface.evaluate(static_cast<int>(f), at.part, static_cast<double>(at.i) / n,
                                static_cast<double>(at.j) / n);
      };
      std::vector<std::vector<Vec3>> values(faces.size());
      std::vector<std::vector<std::array<Vec3, 2>>> slopes(faces.size());
      std::map<BorderPoint, Vec3> agreed;
      BorderPoint point{};
      const auto each = [&](const auto& body) {
        for (std::size_t f = 0; f < faces.size(); ++f)
          for (std::size_t v = 0; faces[f] != nullptr && v < faces[f]->vertices.size(); ++v)
            body(f, v, faces[f]->vertices[v]);
      };
      each([&](std::size_t f, std::size_t v, const Corner& corner) {
        values[f].resize(faces[f]->vertices.size());
        slopes[f].resize(values[f].size());
        const auto at = evaluate(f, corner.at);
        values[f][v] = at.position;
        slopes[f][v] = {at.d1, at.d2};
        if (on_border(cut[f], domain(f), corner, depth[f], point) >= 0)
          agree(agreed.try_emplace(point, values[f][v]).first->second, values[f][v]);
      });
      each([&](std::size_t f, std::size_t v, const Corner& corner) {
        if (on_border(cut[f], domain(f), corner, depth[f], point) >= 0) values[f][v] = agreed.at(point);
      });
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
  const Sides sides_;
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
