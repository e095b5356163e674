// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "reference/surface/channel.h"
#include "verify/checks/checks.h"
#include "verify/evidence/other_channel.h"
#include "verify/evidence/vector.h"
#include "verify/row/bounds.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {
namespace {

// A corner of a triangle, and which of the places where corners lie it lies at.
struct Corner {
  std::int64_t triangle;
  int k;
  std::size_t at;
};

// All corners, and each place on a face once.
struct Corners {
  explicit Corners(const Evidence& e) {
    std::map<std::array<std::int64_t, 4>, std::size_t> known;
    for (std::int64_t t = 0; t < e.tessellation.triangle_count(); ++t) {
      std::array<Lattice::Coordinates, 3> at;
      if (!e.place(t, at)) continue;  // `coverage` says so
      const std::int32_t face = e.tessellation.triangle_face()[t];
      for (int k = 0; k < 3; ++k) {
        const auto& [i, j, part] = at[static_cast<std::size_t>(k)];
        const auto [found, is_new] = known.try_emplace({face, part, i, j}, places.size());
        if (is_new) {
          places.push_back(e.lattice.place(face, at[static_cast<std::size_t>(k)]));
          ids.push_back(e.lattice.id(places.back()));
          terms.push_back(e.reference.terms_at(ids.back()));
        }
        all.push_back({t, k, found->second});
      }
    }
  }

  std::vector<Corner> all{};
  std::vector<Place> places{};
  std::vector<Lattice::Id> ids{};     // of each place
  std::vector<std::int64_t> terms{};  // of the longest sum there
};

// Three components, and their derivatives.
struct Point {
  Vector value{};
  std::array<Vector, 2> derivative{};
  bool has_derivatives = true;
};
Point point_of(const auto& p) {
  return {vector_of(p.position), {vector_of(p.d1), vector_of(p.d2)}, p.first_exist};
}
double distance(const Vector& a, const Vector& b) {
  const Vector off = a - b;
  return std::hypot(off[0], off[1], off[2]);
}

Point evaluate(const reference::ChannelSurface& surface, const Place& p) {
  return point_of(
      surface.evaluate(p.face, p.corner, double(p.i) / p.denominator, double(p.j) / p.denominator));
}

// At most three components of a channel of the mesh.
class Part {
 public:
  Part(const Evidence& e, std::size_t channel, int first)
      : e_(e),
        channel_(channel),
        first_(first),
        count_(std::min(3, e.mesh.channels[channel].components - first)),
        values_(e.mesh.channels[channel].some(first, count_)) {
    for (int k = 0; k < count_; ++k) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (auto i = static_cast<std::size_t>(k); i < values_.values.size();
           i += static_cast<std::size_t>(count_)) {
        low = std::min(low, values_.values[i]);
        high = std::max(high, values_.values[i]);
      }
      magnitude_ = std::max({magnitude_, std::abs(low), std::abs(high)});
      diagonal_ = std::hypot(diagonal_, high - low);
    }
    diagonal_ = unit_of_length(diagonal_, magnitude_);
  }

  const data::Channel& channel() const { return values_; }
  data::ChannelRule rule() const { return values_.rule.value_or(data::kUsualChannelRule); }

  double bound(std::int64_t terms = kOrdinaryTerms) const {
    return position_bound(e_.capabilities.precision, e_.reference.steps(), magnitude_, diagonal_, terms);
  }
  double derivative_bound(std::int64_t terms = kOrdinaryTerms) const {
    return channel_derivative_bound(bound(terms), e_.reference.steps());
  }

  // What came.
  Point got(const Corner& c) const {
    Point p;
    const Tessellation& t = e_.tessellation;
    p.has_derivatives = t.has_channel_derivatives();
    for (int k = 0; k < count_; ++k) {
      const auto at = static_cast<std::size_t>(k);
      p.value[at] = t.channel_value(channel_, c.triangle, c.k, first_ + k);
      for (int by = 0; by < 2 && p.has_derivatives; ++by)
        p.derivative[static_cast<std::size_t>(by)][at] =
            t.channel_derivative(channel_, c.triangle, c.k, first_ + k, by);
    }
    return p;
  }
  // What should come.
  std::vector<Point> expected(const std::vector<Place>& places) const {
    if (!surface_)
      surface_ = std::make_unique<reference::ChannelSurface>(e_.mesh, values_, rule(), e_.lattice.scheme());
    std::vector<Point> all(places.size());
    tbb::parallel_for(std::size_t{0}, places.size(),
                      [&](std::size_t k) { all[k] = evaluate(*surface_, places[k]); });
    return all;
  }
  // Whether another channel explains what is wrong. Most are seen not to at a few corners.
  bool fits(const Corners& corners, const data::Channel& channel, data::ChannelRule by_rule,
            std::int64_t wrong) const {
    const reference::ChannelSurface surface(e_.mesh, channel, by_rule, e_.lattice.scheme());
    std::vector<std::optional<Point>> known(corners.places.size());
    const std::size_t count = corners.all.size(), stride = count / 97 + 1;
    std::int64_t bad = 0;
    for (std::size_t first = 0; first < stride; ++first)
      for (std::size_t c = first; c < count; c += stride) {
        const Corner& corner = corners.all[c];
        std::optional<Point>& point = known[corner.at];
        if (!point) point = evaluate(surface, corners.places[corner.at]);
        const double off = error(got(corner), *point);
        if (off > bound() && !explains(++bad, wrong, std::ssize(corners.all))) return false;
      }
    return true;
  }
  Point certified(const Place& p) const {
    if (!certified_)
      certified_ =
          std::make_unique<reference::ChannelEvaluator>(e_.mesh, values_, rule(), e_.lattice.scheme());
    return point_of(certified_->evaluate(p.face, p.corner, reference::Parameter::fraction(p.i, p.denominator),
                                         reference::Parameter::fraction(p.j, p.denominator), 20)[0]);
  }

  // In diagonals; negative where nothing can be judged.
  double error(const Point& got, const Point& expected) const {
    return is_finite(got.value) ? distance(got.value, expected.value) / diagonal_ : -1;
  }
  double derivative_error(const Point& got, const Point& expected) const {
    const auto& [by_u, by_v] = got.derivative;
    if (!got.has_derivatives || !expected.has_derivatives) return -1;
    if (!is_finite(by_u) || !is_finite(by_v)) return std::numeric_limits<double>::infinity();
    return std::hypot(distance(by_u, expected.derivative[0]), distance(by_v, expected.derivative[1])) /
           diagonal_;
  }
  // Of the components that there are.
  std::vector<double> shown(const Vector& values) const { return {values.begin(), values.begin() + count_}; }

 private:
  const Evidence& e_;
  std::size_t channel_;
  int first_, count_;
  data::Channel values_;  // of these components alone
  double magnitude_ = 0, diagonal_ = 0;
  mutable std::unique_ptr<const reference::ChannelSurface> surface_;
  mutable std::unique_ptr<const reference::ChannelEvaluator> certified_;
};

// A row of all parts. Channels of other sizes have other bounds: their errors are in units of the first one's.
class ChannelRow {
 public:
  using Bound = double (Part::*)(std::int64_t) const;
  using Error = double (Part::*)(const Point&, const Point&) const;

  ChannelRow(const Evidence& e, const Corners& corners, const std::vector<Part>& parts, const char* check,
             const char* unit, Bound bound, Error error)
      : e_(e),
        corners_(corners),
        parts_(parts),
        bound_(bound),
        error_(error),
        row_(e.result(check, unit, (parts[0].*bound)(kOrdinaryTerms))) {}

  // Of the next part; returns how many corners are beyond their bounds.
  std::int64_t add(const std::vector<Point>& expected) {
    const Part& part = parts_[errors_.size() / corners_.all.size()];
    std::int64_t bad = 0;
    for (std::size_t c = 0; c < corners_.all.size(); ++c) {
      const double off = (part.*error_)(part.got(corners_.all[c]), expected[corners_.all[c].at]);
      errors_.push_back(off < 0 ? off : off * unit_of(part));
      bad += off > 0 && !(errors_.back() <= bound_at(errors_.size() - 1));
    }
    return bad;
  }

  Result result() {
    const auto bound = [&](std::size_t k) { return bound_at(k); };
    const Confirmation confirmation = confirm(errors_, bound, [&](std::size_t k) {
      const Part& part = part_of(k);
      const double off = (part.*error_)(part.got(corner_of(k)), part.certified(place_of(k)));
      return off < 0 ? off : off * unit_of(part);
    });
    const std::int64_t at =
        judge(errors_, bound, *row_.bound, confirmation.worst, "at vertices of high valence", row_);
    row_.decades = decades(errors_);
    count_places(
        row_, e_.lattice, errors_.size(), [&](std::size_t k) { return corners_.ids[corner_of(k).at]; },
        [&](std::size_t k) { return errors_[k] < 0 ? -1 : static_cast<int>(!(errors_[k] <= bound(k))); });
    say(row_, confirmation.message);
    if (at >= 0) show(static_cast<std::size_t>(at));
    return row_;
  }

 private:
  const Part& part_of(std::size_t k) const { return parts_[k / corners_.all.size()]; }
  const Corner& corner_of(std::size_t k) const { return corners_.all[k % corners_.all.size()]; }
  const Place& place_of(std::size_t k) const { return corners_.places[corner_of(k).at]; }
  double unit_of(const Part& part) const {
    return (parts_[0].*bound_)(kOrdinaryTerms) / (part.*bound_)(kOrdinaryTerms);
  }
  double bound_at(std::size_t k) const {
    return (part_of(k).*bound_)(corners_.terms[corner_of(k).at]) * unit_of(part_of(k));
  }
  void show(std::size_t k) {
    const Part& part = part_of(k);
    const Corner& c = corner_of(k);
    Witness& w = row_.witness.emplace(e_.at(place_of(k)));
    w.vertex = e_.tessellation.triangles()[c.triangle][static_cast<std::size_t>(c.k)];
    w.triangle = c.triangle;
    name_channel(w, part.channel());
    const Point got = part.got(c),
                is = is_bad(row_) ? part.certified(place_of(k)) : part.expected({place_of(k)})[0];
    const auto put = [&](std::vector<double>& to, const Point& p) {
      if (bound_ == &Part::bound) return void(to = part.shown(p.value));
      for (const Vector& d : p.derivative)
        for (const double x : part.shown(d)) to.push_back(x);
    };
    put(w.got, got), put(w.expected, is);
  }

  const Evidence& e_;
  const Corners& corners_;
  const std::vector<Part>& parts_;
  Bound bound_;
  Error error_;
  Result row_;
  std::vector<double> errors_{};  // of all corners of the first part, then of the next
};

// Of each point, on its side of a seam, the corners that have it: the numbers of the cut mesh tell the sides apart.
void check_shared_values(const Evidence& e, const Corners& corners, std::size_t channel, Result& row) {
  data::ControlMesh cut = e.mesh;
  cut.faces = reference::faces_of_cut(e.mesh, e.mesh.channels[channel]);
  std::int32_t most = 0;
  for (const std::int32_t v : cut.faces.corners()) most = std::max(most, v);
  cut.positions.resize(static_cast<std::size_t>(most) + 1);
  cut.sharpness = {};
  std::span<const Place> anywhere;
  if (e.capabilities.points_anywhere != 0) anywhere = corners.places;
  const Lattice lattice(cut, e.lattice.scheme(), e.lattice.depth(), anywhere);
  std::vector<Lattice::Id> ids;
  for (const Place& p : corners.places) ids.push_back(lattice.id(p));
  std::unordered_map<Lattice::Id, const Corner*> first;
  std::unordered_set<Lattice::Id> several, different;
  for (const Corner& c : corners.all) {
    const Lattice::Id id = ids[c.at];
    const auto [found, is_new] = first.try_emplace(id, &c);
    if (is_new) continue;
    several.insert(id);
    const auto a = e.tessellation.channel_bits(channel, c.triangle, c.k),
               b = e.tessellation.channel_bits(channel, found->second->triangle, found->second->k);
    if (std::memcmp(a.data(), b.data(), a.size()) == 0 || !different.insert(id).second || row.witness)
      continue;
    row.witness = e.at(corners.places[c.at]);
    row.witness->vertex = e.tessellation.triangles()[c.triangle][static_cast<std::size_t>(c.k)];
    name_channel(*row.witness, e.mesh.channels[channel]);
  }
  row.of += static_cast<std::int64_t>(several.size());
  row.bad += static_cast<std::int64_t>(different.size());
}

}  // namespace

std::vector<Result> check_channels(const Evidence& e) {
  Result positions = e.result("channel-positions"), derivatives = e.result("channel-derivatives"),
         shared = e.result("channel-shared", "points", 0);
  const auto unlooked = [&](Status status, const char* why) {
    for (Result* row : {&positions, &derivatives, &shared}) row->status = status, row->message = why;
    return std::vector<Result>{positions, derivatives, shared};
  };
  if (e.mesh.channels.empty())
    return unlooked(Status::kNotSupported, "was handed no channel: it does not do the rule");
  if (e.tessellation.channel_count() == 0)
    return unlooked(Status::kNotRun, "no channel values were delivered");
  if (e.capabilities.points != LC_POINTS_LIMIT)
    return unlooked(Status::kNotSupported, "delivers no limit points");

  const Corners corners(e);
  if (corners.all.empty()) return unlooked(Status::kNotRun, "there is no triangle whose corners are known");
  for (std::size_t c = 0; c < e.mesh.channels.size(); ++c) check_shared_values(e, corners, c, shared);
  settle(shared);

  std::vector<Part> parts;
  for (std::size_t c = 0; c < e.mesh.channels.size(); ++c)
    for (int first = 0; first < e.mesh.channels[c].components; first += 3) parts.emplace_back(e, c, first);
  ChannelRow of_values(e, corners, parts, "channel-positions", "diagonal of the channel", &Part::bound,
                       &Part::error),
      of_derivatives(e, corners, parts, "channel-derivatives", "diagonal of the channel",
                     &Part::derivative_bound, &Part::derivative_error);
  const bool differentiates = e.tessellation.has_channel_derivatives();
  std::string said;
  std::int64_t without = 0, not_finite = 0;
  for (const Part& part : parts) {
    const std::vector<Point> expected = part.expected(corners.places);
    for (const Corner& c : corners.all) {
      not_finite += !is_finite(part.got(c).value);
      without += !expected[c.at].has_derivatives;
    }
    if (const std::int64_t wrong = of_values.add(expected); wrong > 0 && said.empty())
      said = other_channels(e.mesh, part.channel(), [&](const data::Channel& other, data::ChannelRule rule) {
        return part.fits(corners, other, rule, wrong);
      });
    if (differentiates) of_derivatives.add(expected);
  }
  positions = of_values.result();
  say(positions, said);
  say_left_out(positions, not_finite, "values");
  if (differentiates) {
    derivatives = of_derivatives.result();
    if (without > 0) say(derivatives, fmt::format("{} more where the limit has no derivatives", without));
  } else {
    derivatives.status = e.capabilities.channel_derivatives != 0 ? Status::kNotRun : Status::kNotSupported;
    derivatives.message = "delivers no derivatives of channels";
  }
  return {positions, derivatives, shared};
}

}  // namespace limitcheck::verify
