// SPDX-License-Identifier: MIT
#include "reference/channel/channel_mesh.h"

#include <algorithm>
#include <set>

#include "data/error.h"
#include "reference/point/parameter_exact.h"

namespace limitcheck::reference {
namespace {

/// The indices of a control mesh, by which its values are classified.
class Classifier {
 public:
  Classifier(const ChannelTopology& channel, std::span<const std::int32_t> values, data::ChannelRule rule)
      : channel_(channel), values_(values), rule_(rule) {}

  /// The states of the values of a vertex's runs, in their order.
  std::vector<ValueState> states(std::int32_t v) const {
    const Sector sector = channel_.topology.sector(v);
    const std::vector<Run> runs = channel_.runs(v);
    const bool seam =
        std::any_of(sector.edges.begin(), sector.edges.end(), [&](std::int32_t e) { return is_seam(e); });
    const Rational& own = channel_.sharpness.vertex(v);
    const bool corner_of_one_face = !sector.closed && sector.faces.size() == 1 &&
                                    rule_ != data::ChannelRule::kNone && !Sharpness::is_infinite(own);
    if (!seam && !corner_of_one_face && (sector.closed || rule_ < data::ChannelRule::kBoundaries))
      return {ValueState::kMatches};
    if (rule_ >= data::ChannelRule::kBoundaries || Sharpness::is_infinite(own))
      return {runs.size(), ValueState::kHeld};

    std::vector<Value> values;
    std::set<std::int32_t> different;
    for (const Run& run : runs) {
      values.push_back(value(v, sector, run));
      different.insert(values.back().index);
    }
    for (Value& a : values)
      a.is_parted =
          std::count_if(values.begin(), values.end(), [&](const Value& b) { return a.index == b.index; }) > 1;
    const bool propagates =
        rule_ == data::ChannelRule::kCornersPlus1 || rule_ == data::ChannelRule::kCornersPlus2;
    if (propagates && all_are_held(sector, values, different.size())) return {runs.size(), ValueState::kHeld};

    std::vector<ValueState> result;
    for (const Value& a : values) {
      const bool other_is_semi_sharp = propagates && different.size() == 2 &&
                                       std::any_of(values.begin(), values.end(), [&](const Value& b) {
                                         return b.index != a.index && b.has_semi_sharp_edge;
                                       });
      result.push_back(a.is_parted || a.has_infinite_edge                  ? ValueState::kHeld
                       : a.faces == 1 && rule_ != data::ChannelRule::kNone ? ValueState::kHeld
                       : a.has_semi_sharp_edge                             ? ValueState::kSemiSharp
                       : other_is_semi_sharp                               ? ValueState::kDependent
                       : own > 0                                           ? ValueState::kSemiSharp
                                                                           : ValueState::kCrease);
    }
    return result;
  }

 private:
  struct Value {
    std::int32_t index;
    std::size_t faces;
    bool is_parted = false, has_infinite_edge = false, has_semi_sharp_edge = false;
  };

  bool is_seam(std::int32_t e) const { return channel_.seams[static_cast<std::size_t>(e)]; }

  Value value(std::int32_t v, const Sector& sector, const Run& run) const {
    Value result{values_[channel_.corner(channel_.face(sector, run, 0), v)], run.count};
    for (std::size_t i = 1; i < run.count; ++i) {
      const Rational& s = channel_.sharpness.edge(sector.edges[channel_.edge(sector, run, i)]);
      result.has_infinite_edge = result.has_infinite_edge || Sharpness::is_infinite(s);
      result.has_semi_sharp_edge = result.has_semi_sharp_edge || Sharpness::is_semi_sharp(s);
    }
    return result;
  }

  // By corners-plus1 and corners-plus2: what one value has can hold them all.
  bool all_are_held(const Sector& sector, const std::vector<Value>& values, std::size_t different) const {
    const bool more = rule_ == data::ChannelRule::kCornersPlus2;
    if (different > 2) return true;
    if (different == 1) return more && sector.closed && values.size() == 1;  // the end of a seam
    return std::any_of(values.begin(), values.end(), [&](const Value& a) {
      return a.has_infinite_edge || a.is_parted || (more && a.faces == 1);
    });
  }

  const ChannelTopology& channel_;
  std::span<const std::int32_t> values_;
  data::ChannelRule rule_;
};

}  // namespace

ChannelTopology::ChannelTopology(Topology mesh, const SharpTags& tags, std::span<const std::int32_t> values,
                                 data::ChannelRule rule)
    : topology(std::move(mesh)), sharpness(topology, tags), seams(topology.edges().size(), false) {
  if (values.size() != topology.faces().corners().size())
    throw data::ArgumentError("a channel has an index for each corner of the mesh");
  for (std::size_t e = 0; e < seams.size(); ++e) {
    const Edge& edge = topology.edges()[e];
    if (edge.on_boundary()) continue;
    for (const std::int32_t v : {edge.a, edge.b})
      seams[e] = seams[e] || values[corner(edge.left_face, v)] != values[corner(edge.right_face, v)];
  }
  states.resize(values.size());
  const Classifier classifier(*this, values, rule);
  for (std::size_t id = 0; id < topology.vertex_count(); ++id) {
    const auto v = static_cast<std::int32_t>(id);
    const Sector sector = topology.sector(v);
    if (sector.faces.empty()) continue;
    const std::vector<Run> all = runs(v);
    const std::vector<ValueState> found = classifier.states(v);
    for (std::size_t r = 0; r < all.size(); ++r)
      for (std::size_t i = 0; i < all[r].count; ++i) states[corner(face(sector, all[r], i), v)] = found[r];
  }
}

std::vector<Run> ChannelTopology::runs(std::int32_t v) const {
  const Sector sector = topology.sector(v);
  const std::size_t faces = sector.faces.size();
  std::vector<std::size_t> starts;
  if (!sector.closed) starts.push_back(0);
  for (std::size_t i = sector.closed ? 0 : 1; i < faces; ++i)
    if (seams[static_cast<std::size_t>(sector.edges[i])]) starts.push_back(i);
  if (starts.empty()) return {{0, faces}};
  std::vector<Run> result;
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const std::size_t end = s + 1 < starts.size() ? starts[s + 1] : sector.closed ? starts[0] + faces : faces;
    result.push_back({starts[s], end - starts[s]});
  }
  return result;
}

std::size_t ChannelTopology::corner(std::int32_t face, std::int32_t v) const {
  const auto f = static_cast<std::size_t>(face);
  const auto corners = topology.faces()[f];
  return topology.faces().first_corner(f) +
         static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin());
}

std::vector<ChannelTopology::Holding> ChannelTopology::holding(std::int32_t v, const Run& run) const {
  const Sector sector = topology.sector(v);
  const Rational& own = sharpness.vertex(v);
  std::vector<Holding> result{{own, Sharpness::one_less(own)}};
  const bool of_others = states[corner(face(sector, run, 0), v)] == ValueState::kDependent;
  for (const Run& other : runs(v)) {
    if ((other.first == run.first) == of_others) continue;
    for (std::size_t i = 1; i < other.count; ++i) {
      const std::int32_t e = sector.edges[edge(sector, other, i)];
      result.push_back({sharpness.edge(e), sharpness.half_after_step(topology, e, v)});
    }
  }
  return result;
}

bool ChannelTopology::is_semi_sharp(std::size_t face) const {
  const auto corners = topology.faces()[face];
  return std::any_of(corners.begin(), corners.end(), [&](std::int32_t v) {
    const auto edges = topology.sector(v).edges;
    return Sharpness::is_semi_sharp(sharpness.vertex(v)) ||
           std::any_of(edges.begin(), edges.end(), [&](std::int32_t e) {
             return !topology.edges()[static_cast<std::size_t>(e)].on_boundary() &&
                    Sharpness::is_semi_sharp(sharpness.edge(e));
           });
  });
}

ChannelCut cut_and_hold(const ChannelTopology& channel, data::TriangleRule triangles) {
  const Topology& topology = channel.topology;
  ChannelCut result{topology.faces(), {}, {}};
  result.tags.creasing = channel.sharpness.creasing();
  result.tags.triangles = triangles;
  const auto exact = [](const Rational& s) { return Parameter::parse(s.str()); };
  for (std::size_t id = 0; id < topology.vertex_count(); ++id) {
    const auto v = static_cast<std::int32_t>(id);
    const Sector sector = topology.sector(v);
    if (sector.faces.empty()) continue;
    for (const Run& run : channel.runs(v)) {
      const std::size_t first = channel.corner(channel.face(sector, run, 0), v);
      const auto copy = static_cast<std::int32_t>(result.corner_of.size());
      result.corner_of.push_back(first);
      for (std::size_t i = 0; i < run.count; ++i) {
        const std::int32_t f = channel.face(sector, run, i);
        const std::size_t k =
            channel.corner(f, v) - topology.faces().first_corner(static_cast<std::size_t>(f));
        result.faces[static_cast<std::size_t>(f)][k] = copy;
      }
      const ValueState state = channel.states[first];
      const Rational sharpness = state == ValueState::kHeld ? Rational(10) : channel.sharpness.vertex(v);
      if (sharpness > 0) result.tags.vertices.push_back({copy, exact(sharpness)});
      if (state == ValueState::kMatches) continue;
      std::vector<bool> is_inside(sector.edges.size(), false);
      for (std::size_t i = 1; i < run.count; ++i) is_inside[channel.edge(sector, run, i)] = true;
      for (std::size_t i = 0; i < is_inside.size(); ++i) {
        const std::int32_t e = sector.edges[i];
        const Rational& beyond = channel.sharpness.edge(e);
        const bool holds = state == ValueState::kDependent && !channel.seams[static_cast<std::size_t>(e)];
        if (!is_inside[i] && Sharpness::is_semi_sharp(beyond) &&
            !topology.edges()[static_cast<std::size_t>(e)].on_boundary() &&
            (holds || channel.sharpness.creasing() == data::Creasing::kChaikin))
          result.tags.beyond.push_back({copy, exact(beyond), holds});
      }
    }
  }
  for (std::size_t e = 0; e < topology.edges().size(); ++e) {
    const Edge& edge = topology.edges()[e];
    const Rational& sharpness = channel.sharpness.edge(static_cast<std::int32_t>(e));
    if (sharpness == 0 || edge.on_boundary() || channel.seams[e]) continue;
    const auto left = static_cast<std::size_t>(edge.left_face);
    const auto copy = [&](std::int32_t end) {
      return result.faces[left][channel.corner(edge.left_face, end) - topology.faces().first_corner(left)];
    };
    result.tags.edges.push_back({copy(edge.a), copy(edge.b), exact(sharpness)});
  }
  return result;
}

}  // namespace limitcheck::reference
