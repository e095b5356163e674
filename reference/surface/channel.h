// SPDX-License-Identifier: MIT
// Certified values of a face-varying channel: decimal numbers with radii that are guaranteed to hold the true values.
#pragma once

#include <memory>
#include <vector>

#include "data/channel.h"
#include "data/control_mesh.h"
#include "data/scheme.h"
#include "reference/point/surface_point.h"
#include "reference/surface/certified.h"

namespace limitcheck::reference {

/// The limit of a channel and its derivatives by the parameters of a face, exactly as SURFACE.md defines it.
class ChannelEvaluator {
 public:
  /// How the limit is found. The two are of different kind and give the same.
  enum class Method {
    kCut,  ///< the mesh is cut along the seams, and its ordinary surface evaluated
    kSteps  ///< steps by the channel's rules on the whole mesh as long as semi-sharp tags are near, and then the cut
  };

  /// Numbers are taken as the exact binary fractions they are. Loop's scheme is that with Loop's weights.
  /// Throws data::ArgumentError: as CertifiedEvaluator and data::fault_of say.
  ChannelEvaluator(const data::ControlMesh& mesh, const data::Channel& channel, data::ChannelRule rule,
                   data::Scheme scheme, Method method = Method::kCut);
  ~ChannelEvaluator();

  /// At a point of a face, as CertifiedEvaluator::evaluate, whose `digits` and errors it has.
  ///   returns   for components 0 to 2, and if there are more, for the others: coordinates of positions and derivatives;
  ///             those beyond the last component are 0. There are no normals and curvatures
  std::vector<CertifiedPoint> evaluate(int face, int corner, const Parameter& u, const Parameter& v,
                                       int digits) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

/// The faces of a mesh, corner by corner, where each run of faces between seams of a channel has a vertex of its own.
/// Throws data::ArgumentError as ChannelEvaluator.
data::Faces faces_of_cut(const data::ControlMesh& mesh, const data::Channel& channel);

/// The same in double: of the cut, whose errors are those of Surface; by the rule `all` a few roundings.
class ChannelSurface {
 public:
  /// Throws data::ArgumentError as ChannelEvaluator.
  ChannelSurface(const data::ControlMesh& mesh, const data::Channel& channel, data::ChannelRule rule,
                 data::Scheme scheme);
  ~ChannelSurface();

  /// The first three components and their derivatives by the parameters. Any number of threads may ask.
  SurfacePoint<double> evaluate(int face, int corner, double u, double v) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace limitcheck::reference
