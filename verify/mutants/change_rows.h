// SPDX-License-Identifier: MIT
// What the tables of faults and habits are written with. Private to them.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "verify/mutants/faulty_subjects.h"

namespace limitcheck::verify {

/// A table in the making.
struct Rows : std::vector<Change> {
  void operator+=(Change c) { push_back(std::move(c)); }
};

// The tables, by what they are about; each of faulty_subjects.h is made of some.
void faults_of_channel_derivatives(Rows& to);
void faults_of_channels(Rows& to);
void faults_of_frames(Rows& to);
void faults_of_numbers(Rows& to);
void faults_of_refusals(Rows& to);
void faults_of_sharp_rules(Rows& to);
void faults_of_memory(Rows& to);
void faults_of_polygons(Rows& to);
void faults_of_tags(Rows& to);
void faults_of_rare_tags(Rows& to);
void faults_of_rare_places(Rows& to);

/// The three triangles of one control face round a lattice point inside one of its edges, in order: together
/// they have the corners a, x, y, b and m lies between a and b.
struct HalfFan {
  std::array<std::size_t, 3> triangles;
  std::uint32_t m, a, x, y, b;
};
/// The first that is wanted, of which is told how many triangles of the face there are at m.
HalfFan half_fan(const Delivered& out, const std::function<bool(const HalfFan&, std::size_t)>& wanted);
/// Two triangles in place of its three, which leave out m.
void leave_out(Delivered& out, const HalfFan& fan);

namespace rows {

using A = const Asked&;
using D = Delivered&;
using Depths = std::vector<std::int32_t>&;
using Mesh = data::ControlMesh&;
using Tags = data::Sharpness&;
using Vector = Delivered::Vector;
using On = Change::On;

/// What faults.txt tells of it.
Change row(std::string_view name);
/// With one member more.
template <class Member, class Value>
Change with(Change c, Member Change::*member, Value value) {
  c.*member = std::move(value);
  return c;
}
inline Change deliver(const std::string& name, std::function<void(A, D)> what) {
  return with(row(name), &Change::deliver, std::move(what));
}
/// A vertex that was delivered.
struct At {
  A a;
  D out;
  std::size_t v;
  Place p;
  Vector& position() const { return out.positions[v]; }
  Vector& normal() const {
    if (out.normals.empty()) nowhere("normal");
    return out.normals[v];
  }
  std::size_t face() const { return Asked::face_of(p); }
  FaceDomain domain() const { return a.domain(face()); }
  std::int64_t steps() const { return a.steps(p); }
  std::optional<FaceDomain::SidePoint> side() const { return a.side_of(p); }
  bool inside_face() const { return !side(); }
  std::int32_t control_vertex() const { return a.control_vertex(p); }
};
/// What is done to each vertex.
inline Change vertex(const std::string& name, std::function<void(const At&)> what) {
  return deliver(name, [what](A a, D out) {
    for (std::size_t v = 0; v < out.positions.size(); ++v) what({a, out, v, out.place(v)});
  });
}
inline Change ask(const std::string& name, std::function<void(A, Depths)> what) {
  return with(row(name), &Change::ask, std::move(what));
}
inline Change declare(const std::string& name, std::function<void(lc_capabilities&)> what) {
  return with(row(name), &Change::declare, std::move(what));
}
inline Change take(const std::string& name, std::function<void(Mesh)> what) {
  return with(row(name), &Change::take, std::move(what));
}
inline Change remake(const std::string& name, std::function<void(A, Mesh)> what) {
  return with(row(name), &Change::remake, std::move(what));
}
/// Other tags, where there are some.
inline Change tags(const std::string& name, std::function<void(A, Tags)> what) {
  Change c = remake(name, [what](A a, Mesh m) { what(a, m.sharpness); });
  if (c.check == "positions")
    c.shows = [what](A a) {
      data::Sharpness changed = a.mesh.sharpness;
      what(a, changed);
      return !(changed == a.mesh.sharpness);
    };
  return c;
}
/// At a vertex with more edges than that, only the first ones have tags.
void lose_edges_beyond(Tags t, int most);
/// Each sharpness becomes what `value` makes of it; 0 is no tag.
template <class Value>
void each_sharpness(Tags t, Value value) {
  const auto change = [&](auto& list) {
    for (auto& tag : list) tag.sharpness = value(tag.sharpness);
    std::erase_if(list, [](const auto& tag) { return tag.sharpness == 0; });
  };
  change(t.edges), change(t.vertices);
}
inline Change values(const std::string& name, std::function<float(A, float)> value) {
  return tags(name, [value](A a, Tags t) { each_sharpness(t, [&](float s) { return value(a, s); }); });
}

inline bool lasts(float sharpness) {
  return sharpness >= data::kInfiniteSharpness;
}
inline bool inside_face(A a, const Place& p) {
  return !a.side_of(p);
}
inline bool same_edge(const auto& e, std::int32_t a, std::int32_t b) {
  return std::minmax(e.a, e.b) == std::minmax(a, b);
}
inline void add(Vector& to, const Vector& what, double times) {
  for (std::size_t c = 0; c < 3; ++c) to[c] += times * what[c];
}
/// Each coordinate by `one`.
template <class One>
void each(Vector& p, One one) {
  for (double& x : p) x = one(x);
}

inline Vector difference(const Vector& p, const Vector& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}
inline Vector unit(const Vector& n) {
  const double size = std::hypot(n[0], n[1], n[2]);
  return {n[0] / size, n[1] / size, n[2] / size};
}
/// Of unit length.
inline Vector unit_cross(const Vector& p, const Vector& q) {
  return unit({p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]});
}

/// Each vertex moves along its normal, by a share of the box.
inline Change outwards(const std::string& name, std::function<double(const At&)> share) {
  return vertex(name, [share](const At& at) {
    if (const double by = share(at); by != 0 && !at.out.normals.empty())
      add(at.position(), at.normal(), by * at.a.diagonal);
  });
}
/// Each coordinate of each position becomes what `one` makes of it.
inline Change positions(const std::string& name, std::function<double(A, double)> one) {
  return vertex(name, [one](const At& at) { each(at.position(), [&](double x) { return one(at.a, x); }); });
}
/// Normals become what `what` makes of them.
inline Change normals(const std::string& name, std::function<void(Vector&)> what) {
  return deliver(name, [what](A, D out) {
    if (out.normals.empty() && !out.positions.empty()) nowhere("normal");
    for (Vector& n : out.normals) what(n);
  });
}
inline void negate(Vector& n) {
  each(n, std::negate<>());
}

/// Moves the vertices that `is_off` names by their places along x by 1e-5 of the largest coordinate.
inline Change moved(const std::string& name, std::function<bool(A, const Place&)> is_off) {
  Change c = row(name);
  c.deliver = [is_off](A a, D out) {
    for (std::size_t v = 0; v < out.positions.size(); ++v)
      if (is_off(a, out.place(v))) out.positions[v][0] += 1e-5 * a.largest;
  };
  return c;
}
/// Whether a vertex lies inside amid more faces than that; -1 is none.
inline bool amid_more(A a, std::int32_t v, int most) {
  return v >= 0 && a.inside(v) && a.faces(v) > most;
}

/// Where the points of each face lie in what was delivered, by their parameters.
class Finder {
 public:
  explicit Finder(const Delivered& out) {
    for (std::size_t v = 0; v < out.positions.size(); ++v) at_[key(out.place(v))] = v;
  }
  /// Of a triangle: the vertex at l1 = i / n, l2 = j / n.
  std::size_t operator()(std::int32_t face, std::int64_t i, std::int64_t j, std::int64_t n) const {
    const auto found = at_.find({face, static_cast<double>(i) / static_cast<double>(n),
                                 static_cast<double>(j) / static_cast<double>(n)});
    if (found == at_.end()) nowhere("point of a face");
    return found->second;
  }
  std::size_t corner(std::int32_t face, int k) const { return (*this)(face, k == 1, k == 2, 1); }

 private:
  using Key = std::tuple<std::int32_t, double, double>;
  static Key key(const Place& p) {
    return {p.face, static_cast<double>(p.i) / p.denominator, static_cast<double>(p.j) / p.denominator};
  }
  std::map<Key, std::size_t> at_;
};

}  // namespace rows
}  // namespace limitcheck::verify
