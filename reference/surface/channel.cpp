// SPDX-License-Identifier: MIT
#include "reference/surface/channel.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "data/error.h"
#include "reference/channel/channel_mesh.h"
#include "reference/channel/channel_step.h"
#include "reference/point/parameter_exact.h"
#include "reference/surface/near_part.h"
#include "reference/surface/surface.h"

namespace limitcheck::reference {
namespace {

using Block = std::vector<std::array<double, 3>>;  // three components of the values at all corners

template <class N>
std::vector<Vec3<N>> numbers(const Block& block) {
  std::vector<Vec3<N>> result;
  for (const auto& value : block)
    result.push_back({NumberTraits<N>::from_double(value[0]), NumberTraits<N>::from_double(value[1]),
                      NumberTraits<N>::from_double(value[2])});
  return result;
}

/// The cut mesh in whose face 0 a point is, with the values of its vertices.
template <class N>
struct Settled {
  ChannelCut cut;
  std::vector<Vec3<N>> values;
  int corner;
  Rational u, v, factor;  // the last of the derivatives by the parameters of the given face
};

/// Where a point is in face 0 of what is left, which begins at its corner `turn`.
struct Descent {
  int corner;
  Rational u, v, factor;
  std::size_t turn = 0;
};

template <class N>
Settled<N> settled(const ChannelMesh<N>& near, data::TriangleRule triangles, const Descent& at) {
  Settled<N> result{cut_and_hold(near, triangles), {}, at.corner, at.u, at.v, at.factor};
  for (const std::size_t c : result.cut.corner_of) result.values.push_back(near.values[c]);
  const auto corners = result.cut.faces[0];
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(at.turn), corners.end());
  return result;
}

/// Steps on the whole mesh, of what is near a face.
template <class N>
class Steps {
 public:
  Steps(const ChannelMesh<N>& mesh, std::size_t face, data::Scheme scheme, data::TriangleRule triangles)
      : near_(mesh.around(face)), scheme_(scheme), triangles_(triangles) {}

  const ChannelMesh<N>& near() const { return near_; }
  bool done() const { return !near_.is_semi_sharp(0); }
  void to(std::size_t child) { near_ = refine_once(near_, scheme_, triangles_).around(child); }

 private:
  ChannelMesh<N> near_;
  data::Scheme scheme_;
  data::TriangleRule triangles_;
};

// Until they are done.
template <class N>
Descent descend(Steps<N>& steps, int corner, Rational u, Rational v) {
  Rational factor = 1;
  if (!steps.done() && steps.near().topology.faces()[0].size() != 4) {
    steps.to(static_cast<std::size_t>(corner));
    corner = 0;
  }
  for (; !steps.done(); factor *= 2) steps.to(catmull_clark::descend(u, v));
  return {corner, u, v, factor};
}

// The same of triangles. The face is turned so that its parameters run along those of the given one, or against them.
template <class N>
Descent descend_triangles(Steps<N>& steps, const Parameter& first, const Parameter& second) {
  const auto [l1, l2] = exact_parameters(first, second);
  SubFacePath<Rational> path(l1, l2);
  Rational factor = 1;
  for (; !steps.done(); factor *= 2) steps.to(static_cast<std::size_t>(path.descend()));
  std::size_t turn = 0;  // to the corner whose weight falls, or rises, along both parameters
  while (path.gradient[turn][0] != path.gradient[turn][1]) ++turn;
  if (path.gradient[turn][0] == 1) factor = -factor;
  return {0, path.w[(turn + 1) % 3], path.w[(turn + 2) % 3], factor, turn};
}

// The corners between which a channel of the rule `all` is linear or bilinear: those of a triangle of Loop's scheme, of a
// quad, or of the quad at a corner of another face.
template <class N>
std::vector<Vec3<N>> linear_corners(const ChannelMesh<N>& mesh, bool loop, std::size_t face, int corner) {
  const std::size_t n = mesh.topology.faces()[face].size(), k = static_cast<std::size_t>(corner);
  const auto first =
      mesh.values.begin() + static_cast<std::ptrdiff_t>(mesh.topology.faces().first_corner(face));
  const std::vector<Vec3<N>> values(first, first + static_cast<std::ptrdiff_t>(n));
  if (loop || n == 4) return values;
  return {values[k], boundary_edge_point(values[k], values[(k + 1) % n]),
          catmull_clark::face_point<N>(values), boundary_edge_point(values[k], values[(k + n - 1) % n])};
}

// That is the surface of a face by itself whose corners are held.
template <class N>
Settled<N> linear(const ChannelMesh<N>& mesh, bool loop, std::size_t face, int corner, const Rational& u,
                  const Rational& v) {
  Settled<N> result{{}, linear_corners(mesh, loop, face, corner), 0, u, v, 1};
  result.cut.faces = loop ? data::Faces{{0, 1, 2}} : data::Faces{{0, 1, 2, 3}};
  for (std::int32_t vertex = 0; vertex < static_cast<std::int32_t>(result.values.size()); ++vertex)
    result.cut.tags.vertices.push_back({vertex, Parameter(10.)});
  return result;
}

Parameter parameter(const Rational& p) {
  return Parameter::parse(p.str());
}

ChannelTopology topology_of(const data::ControlMesh& mesh, const data::Channel& channel,
                            data::ChannelRule rule) {
  return {Topology(mesh.positions.size(), mesh.faces), mesh.sharpness, channel.corners, rule};
}

void require_valid(const data::ControlMesh& mesh, const data::Channel& channel, data::Scheme scheme) {
  if (const std::string fault = data::fault_of(channel, mesh); !fault.empty())
    throw data::ArgumentError("channel '" + channel.name + "': " + fault);
  if (scheme == data::Scheme::kLoop) (void)triangles_of(mesh);  // or it throws
}

}  // namespace

struct ChannelEvaluator::Data {
  data::Scheme scheme;
  data::ChannelRule rule;
  data::TriangleRule triangles;
  ChannelTopology channel;
  std::vector<Block> blocks{};
  std::vector<std::unique_ptr<const CertifiedEvaluator>> whole{};  // of the cut, if it is asked for

  bool is_loop() const { return scheme == data::Scheme::kLoop; }

  template <class N>
  Settled<N> settled(const Block& block, std::size_t face, int corner, const Parameter& u,
                     const Parameter& v) const {
    const ChannelMesh<N> mesh(channel, numbers<N>(block));
    const Rational a = exact_value(u), b = exact_value(v);
    if (rule == data::ChannelRule::kAll) return linear(mesh, is_loop(), face, corner, a, b);
    Steps<N> steps(mesh, face, scheme, triangles);
    const Descent at = is_loop() ? descend_triangles(steps, u, v) : descend(steps, corner, a, b);
    return reference::settled(steps.near(), triangles, at);
  }
};

ChannelEvaluator::ChannelEvaluator(const data::ControlMesh& mesh, const data::Channel& channel,
                                   data::ChannelRule rule, data::Scheme scheme, Method method) {
  require_valid(mesh, channel, scheme);
  auto data =
      std::make_unique<Data>(Data{scheme, rule, mesh.sharpness.triangles, topology_of(mesh, channel, rule)});
  for (int first = 0; first < channel.components; first += 3) {
    Block block(channel.corners.size());
    for (std::size_t c = 0; c < block.size(); ++c)
      for (int k = first; k < std::min(first + 3, channel.components); ++k)
        block[c][static_cast<std::size_t>(k - first)] = channel.at(c, k);
    data->blocks.push_back(std::move(block));
  }
  if (method == Method::kCut && rule != data::ChannelRule::kAll)
    for (const Block& block : data->blocks) {
      const ChannelCut cut = cut_and_hold(data->channel, data->triangles);
      std::vector<std::array<std::string, 3>> positions;
      for (const std::size_t c : cut.corner_of)
        positions.push_back({Parameter(block[c][0]).to_string(), Parameter(block[c][1]).to_string(),
                             Parameter(block[c][2]).to_string()});
      data->whole.push_back(
          std::make_unique<const CertifiedEvaluator>(positions, cut.faces, scheme, cut.tags));
    }
  data_ = std::move(data);
}

ChannelEvaluator::~ChannelEvaluator() = default;

std::vector<CertifiedPoint> ChannelEvaluator::evaluate(int face, int corner, const Parameter& u,
                                                       const Parameter& v, int digits) const {
  std::vector<CertifiedPoint> result;
  for (const auto& whole : data_->whole)
    result.push_back(whole->evaluate(face, corner, u, v, digits, Wanted::kDerivatives));
  if (!result.empty()) return result;

  const data::Faces& faces = data_->channel.topology.faces();
  if (face < 0 || static_cast<std::size_t>(face) >= faces.size())
    throw data::ArgumentError("no face " + std::to_string(face));
  const auto f = static_cast<std::size_t>(face);
  if (corner < 0 ||
      static_cast<std::size_t>(corner) >= (faces[f].size() == 4 || data_->is_loop() ? 1 : faces[f].size()))
    throw data::ArgumentError("face " + std::to_string(face) + " has no corner " + std::to_string(corner) +
                              " with a domain of its own");
  if (!(u.as_double() >= 0 && u.as_double() <= 1 && v.as_double() >= 0 && v.as_double() <= 1))
    throw data::ArgumentError("parameters must be in 0..1");
  for (const Block& block : data_->blocks) {
    const Settled<double> on = data_->settled<double>(block, f, corner, u, v);
    const auto values = [&] { return data_->settled<Ball>(block, f, corner, u, v).values; };
    result.push_back(certify(
        {on.cut.faces, on.cut.tags, {}, on.corner, parameter(on.u), parameter(on.v), on.factor, values},
        data_->scheme, Weights::kLoop, digits, Wanted::kDerivatives));
  }
  return result;
}

data::Faces faces_of_cut(const data::ControlMesh& mesh, const data::Channel& channel) {
  return cut_and_hold(topology_of(mesh, channel, data::ChannelRule::kNone), {}).faces;
}

struct ChannelSurface::Data {
  bool is_loop;
  ChannelMesh<double> mesh;
  std::optional<Surface> surface{};  // none by the rule `all`
};

ChannelSurface::ChannelSurface(const data::ControlMesh& mesh, const data::Channel& channel,
                               data::ChannelRule rule, data::Scheme scheme) {
  require_valid(mesh, channel, scheme);
  std::vector<Vec3<double>> values(channel.corners.size());
  for (std::size_t c = 0; c < values.size(); ++c)
    for (int k = 0; k < std::min(channel.components, 3); ++k)
      (k == 0 ? values[c].x : k == 1 ? values[c].y : values[c].z) = channel.at(c, k);
  data_.reset(new Data{scheme == data::Scheme::kLoop,
                       ChannelMesh<double>(topology_of(mesh, channel, rule), std::move(values))});
  if (rule == data::ChannelRule::kAll) return;
  const Settled<double> whole = settled(data_->mesh, mesh.sharpness.triangles, {0, 0, 0, 1});
  data_->surface.emplace(whole.cut.faces, whole.values, whole.cut.tags, scheme);
}

ChannelSurface::~ChannelSurface() = default;

SurfacePoint<double> ChannelSurface::evaluate(int face, int corner, double u, double v) const {
  if (data_->surface) return data_->surface->evaluate(face, corner, u, v, Derivatives::kFirst);
  const std::vector<Vec3<double>> c =
      linear_corners(data_->mesh, data_->is_loop, static_cast<std::size_t>(face), corner);
  const Vec3<double> along = c[1] - c[0], across = c.back() - c[0];
  const Vec3<double> twist = data_->is_loop ? Vec3<double>{} : c[2] - c[1] - across;
  SurfacePoint<double> point{};
  point.position = c[0] + along * u + across * v + twist * (u * v);
  point.d1 = along + twist * v, point.d2 = across + twist * u;
  point.first_exist = true;
  return point;
}

}  // namespace limitcheck::reference
