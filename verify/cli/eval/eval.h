// SPDX-License-Identifier: MIT
// limitcheck eval: what is asked, and the ways to answer.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "data/io/read.h"
#include "reference/surface/certified.h"
#include "verify/cli/commands.h"
#include "verify/cli/mesh_options.h"

namespace limitcheck::cli {

struct EvalRequest {
  std::string mesh, face, u, v;
  data::ReadOptions options;
  int digits = 16;
  bool in_float = false;
  reference::Weights weights = reference::Weights::kLoop;
  bool json = false;
  std::string subject, depths = "uniform";
  int depth = 4;
  std::string points;  // the file, or "-"
  bool certified = false;
  int derivatives = 0;
  std::string channel;  // its name; none: positions
  std::optional<data::ChannelRule> channel_rule;
};
inline const Words<reference::Weights> kWeights{{"loop", reference::Weights::kLoop},
                                                {"warren", reference::Weights::kWarren}};

/// "17" or "17:2".
struct FaceAndCorner {
  std::int64_t face = 0;
  std::optional<int> corner;
};
/// Throws data::ArgumentError.
FaceAndCorner parse_face(const std::string& text);
/// The face is there, and it has a corner if it needs one; else throws data::ArgumentError.
void check_face(const EvalRequest& request, const OpenedMesh& opened, const FaceAndCorner& at);
/// Throws data::ArgumentError: weights of the other scheme.
reference::CertifiedEvaluator certified_evaluator(const EvalRequest& request, const OpenedMesh& opened);

/// The channel that is asked for, and its rule: as asked, else as its file says, else the usual one. Throws
/// data::ArgumentError: there is none of that name, or other weights than Loop's are asked for.
struct ChosenChannel {
  const data::Channel& channel;
  data::ChannelRule rule;
};
ChosenChannel channel_of(const EvalRequest& request, const OpenedMesh& opened);

/// What was evaluated: positions, or the values of a channel.
struct EvaluatedPoint {
  const EvalRequest& request;
  MeshScheme chosen;
  FaceAndCorner at;
  std::vector<std::string> parameters;  // exact: l0, l1, l2 of Loop's scheme, u, v of Catmull-Clark's
  /// The point; of a channel of more than three components one more, for the others.
  std::vector<reference::CertifiedPoint> points{};
  std::size_t components = 3;
  data::ChannelRule rule{};
};
void print_point_as_json(const EvaluatedPoint& at);
void print_point(const EvaluatedPoint& at);

/// Evaluates every line FACE,U,V of a file (or of standard input) and writes a line for each, in their order: CSV, or
/// JSON with request.json. On all processors; memory does not grow with the number of lines. Throws data::InputError:
/// the file cannot be read, or a line is no point of the mesh; lines before that one have been written.
void evaluate_points(const EvalRequest& request, const OpenedMesh& opened);

}  // namespace limitcheck::cli
