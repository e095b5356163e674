// SPDX-License-Identifier: MIT
#include "reference/surface/channel.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "data/error.h"
#include "reference/channel/channel_mesh.h"
#include "reference/channel/channel_step.h"
#include "reference/point/parameter_exact.h"

namespace limitcheck::reference {
namespace {

using Values = std::vector<Vec3<Rational>>;

std::array<std::string, 3> text_of(const Vec3<Rational>& value, const Rational& factor) {
  return {Rational(value.x * factor).str(), Rational(value.y * factor).str(),
          Rational(value.z * factor).str()};
}

/// A face on which the channel is to be evaluated, in the cut mesh of which it is face 0, and the point on it.
struct Settled {
  ChannelCut cut;
  Values values;  // of the vertices of the cut
  int corner = 0;
  Parameter u, v;
  Rational factor = 1;  // of the derivatives by the parameters of the given face
};

Settled settled(const ChannelMesh<Rational>& near, data::TriangleRule triangles, int corner,
                const Parameter& u, const Parameter& v) {
  Settled result{cut_and_hold(near, triangles), {}, corner, u, v};
  for (const std::size_t c : result.cut.corner_of) result.values.push_back(near.values[c]);
  return result;
}

Parameter parameter(const Rational& p) {
  return Parameter::parse(p.str());
}

// Steps on the whole mesh, of what is near the point, until no semi-sharp tag is left.
Settled settled_by_steps(const ChannelMesh<Rational>& mesh, data::TriangleRule triangles, std::size_t face,
                         int corner, const Parameter& first, const Parameter& second) {
  ChannelMesh<Rational> near = mesh.around(face);
  Rational factor = 1, u = exact_value(first), v = exact_value(second);
  const auto step_to = [&](std::size_t child) {
    near = refine_once(near, data::Scheme::kCatmullClark, triangles).around(child);
  };
  if (near.is_semi_sharp(0) && near.topology.faces()[0].size() != 4) {
    step_to(static_cast<std::size_t>(corner));
    corner = 0;
  }
  for (; near.is_semi_sharp(0); factor *= 2) {
    const bool right = 2 * u > 1, up = 2 * v > 1;
    u = 2 * u - (right ? 1 : 0), v = 2 * v - (up ? 1 : 0);
    step_to(up ? (right ? 2 : 3) : (right ? 1 : 0));
  }
  Settled result = settled(near, triangles, corner, parameter(u), parameter(v));
  result.factor = factor;
  return result;
}

// The same of triangles. The face is turned so that its parameters run along those of the given one, or against them.
Settled settled_by_loop_steps(const ChannelMesh<Rational>& mesh, std::size_t face, const Parameter& first,
                              const Parameter& second) {
  ChannelMesh<Rational> near = mesh.around(face);
  const auto [l1, l2] = exact_parameters(first, second);
  SubFacePath<Rational> path(l1, l2);
  Rational factor = 1;
  for (; near.is_semi_sharp(0); factor *= 2)
    near = refine_once(near, data::Scheme::kLoop, data::TriangleRule::kCatmark)
               .around(static_cast<std::size_t>(path.descend()));
  std::size_t turn =
      0;  // of the corner whose weight is that of the first corner of the given face, but for its sign
  while (path.gradient[turn][0] != path.gradient[turn][1]) ++turn;
  const int sign = path.gradient[turn][0] == -1 ? 1 : -1;
  Settled result = settled(near, data::TriangleRule::kCatmark, 0, parameter(path.w[(turn + 1) % 3]),
                           parameter(path.w[(turn + 2) % 3]));
  const auto corners = result.cut.faces[0];
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(turn), corners.end());
  result.factor = sign * factor;
  return result;
}

// Linear or bilinear: the surface of a face by itself whose corners are held; of a face that is no quad, of the quad at a
// corner.
Settled linear(const ChannelMesh<Rational>& mesh, bool loop, std::size_t face, int corner, const Parameter& u,
               const Parameter& v) {
  const std::size_t first = mesh.topology.faces().first_corner(face), n = mesh.topology.faces()[face].size();
  Values values(mesh.values.begin() + static_cast<std::ptrdiff_t>(first),
                mesh.values.begin() + static_cast<std::ptrdiff_t>(first + n));
  if (!loop && n != 4) {
    const auto k = static_cast<std::size_t>(corner);
    const Vec3<Rational>& c = values[k];
    values = {c, boundary_edge_point(c, values[(k + 1) % n]), catmull_clark::face_point<Rational>(values),
              boundary_edge_point(c, values[(k + n - 1) % n])};
  }
  Settled result{{}, values, 0, u, v};
  result.cut.faces = loop ? data::Faces{{0, 1, 2}} : data::Faces{{0, 1, 2, 3}};
  for (std::int32_t vertex = 0; vertex < static_cast<std::int32_t>(values.size()); ++vertex)
    result.cut.tags.vertices.push_back({vertex, Parameter(10.)});
  return result;
}

std::unique_ptr<const CertifiedEvaluator> evaluator(const Settled& on, data::Scheme scheme,
                                                    const Rational& factor) {
  std::vector<std::array<std::string, 3>> positions;
  for (const Vec3<Rational>& value : on.values) positions.push_back(text_of(value, factor));
  return std::make_unique<const CertifiedEvaluator>(positions, on.cut.faces, scheme, on.cut.tags);
}

}  // namespace

struct ChannelEvaluator::Data {
  data::Scheme scheme;
  data::ChannelRule rule;
  data::TriangleRule triangles;
  std::vector<ChannelMesh<Rational>> blocks;  // of three components each
  std::optional<ChannelCut> cut;              // if it is exact, and asked for
  std::vector<std::unique_ptr<const CertifiedEvaluator>>
      whole;  // of the cut of each, if it is exact and asked for

  bool is_loop() const { return scheme == data::Scheme::kLoop; }
};

ChannelEvaluator::ChannelEvaluator(const data::ControlMesh& mesh, const data::Channel& channel,
                                   data::ChannelRule rule, data::Scheme scheme, Method method) {
  if (const std::string fault = data::fault_of(channel, mesh); !fault.empty())
    throw data::ArgumentError("channel '" + channel.name + "': " + fault);
  auto data = std::make_unique<Data>(Data{scheme, rule, mesh.sharpness.triangles, {}, {}});
  if (data->is_loop()) (void)triangles_of(mesh);  // or it throws
  const ChannelTopology topology(Topology(mesh.positions.size(), mesh.faces), mesh.sharpness, channel.corners,
                                 rule);
  for (int block = 0; block < channel.components; block += 3) {
    Values values(channel.corners.size());
    const auto component = [&](std::size_t corner, int k) {
      return block + k < channel.components ? Rational(channel.at(corner, block + k)) : Rational(0);
    };
    for (std::size_t c = 0; c < values.size(); ++c)
      values[c] = {component(c, 0), component(c, 1), component(c, 2)};
    data->blocks.emplace_back(topology, std::move(values));
  }
  if (method == Method::kCut && rule != data::ChannelRule::kAll) {
    for (const ChannelMesh<Rational>& block : data->blocks)
      if (const Settled whole = settled(block, data->triangles, 0, 0., 0.); whole.cut.is_exact)
        data->whole.push_back(evaluator(whole, scheme, 1));
  }
  data_ = std::move(data);
}

ChannelEvaluator::~ChannelEvaluator() = default;

std::vector<CertifiedPoint> ChannelEvaluator::evaluate(int face, int corner, const Parameter& u,
                                                       const Parameter& v, int digits) const {
  std::vector<CertifiedPoint> result;
  for (const auto& whole : data_->whole) result.push_back(whole->evaluate(face, corner, u, v, digits));
  if (!result.empty()) return result;

  const data::Faces& faces = data_->blocks[0].topology.faces();
  if (face < 0 || static_cast<std::size_t>(face) >= faces.size())
    throw data::ArgumentError("no face " + std::to_string(face));
  const auto f = static_cast<std::size_t>(face);
  const std::size_t corners = faces[f].size();
  if (corner < 0 || static_cast<std::size_t>(corner) >= (corners == 4 || data_->is_loop() ? 1 : corners))
    throw data::ArgumentError("face " + std::to_string(face) + " has no corner " + std::to_string(corner) +
                              " with a domain of its own");
  for (const ChannelMesh<Rational>& block : data_->blocks) {
    const Settled on = data_->rule == data::ChannelRule::kAll
                           ? linear(block, data_->is_loop(), f, corner, u, v)
                       : data_->is_loop() ? settled_by_loop_steps(block, f, u, v)
                                          : settled_by_steps(block, data_->triangles, f, corner, u, v);
    // Derivatives are those on the face that the steps end in times the factor, or its square: of values so much larger.
    const auto times = [&](const Rational& factor) {
      return evaluator(on, data_->scheme, factor)->evaluate(0, on.corner, on.u, on.v, digits);
    };
    CertifiedPoint point = times(1);
    if (on.factor != 1) {
      const CertifiedPoint first = times(on.factor), second = times(on.factor * on.factor);
      point.d1 = first.d1, point.d2 = first.d2;
      point.d11 = second.d11, point.d12 = second.d12, point.d22 = second.d22;
      point.radius = std::max({point.radius, first.radius, second.radius});
    }
    result.push_back(std::move(point));
  }
  return result;
}

}  // namespace limitcheck::reference
