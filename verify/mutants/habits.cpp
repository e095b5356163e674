// SPDX-License-Identifier: MIT
// Habits that are rare but allowed by subject.h: a name, what it is, and a function that does it.
#include <unistd.h>

#include <cfenv>
#include <clocale>
#include <cstdio>
#include <iostream>
#include <locale>
#include <map>
#include <numeric>

#if defined(__SSE2__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

#include "data/splitmix64.h"
#include "verify/mutants/change_rows.h"

namespace limitcheck::verify {

using namespace rows;

namespace {

Change behaves(const std::string& name, std::function<void()> what) {
  return with(row(name), &Change::behave, std::move(what));
}

// With no vertices or triangles yet; whoever wraps it is told the rest.
Delivered emptied(D out) {
  Delivered all = out;
  out.positions.clear(), out.normals.clear(), out.provenance.clear(), out.corner.clear();
  out.triangles.clear(), out.triangle_face.clear();
  return all;
}

void soup(A, D out) {
  const Delivered all = emptied(out);
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    std::array<std::uint32_t, 3> triangle = all.triangles[t];
    for (std::uint32_t& v : triangle) v = out.add_vertex(all, v);
    out.add_triangle(triangle, all.triangle_face[t]);
  }
}

std::vector<std::size_t> shuffled(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  data::SplitMix64 random(count);
  for (std::size_t k = count; k > 1; --k) std::swap(order[k - 1], order[random.next() % k]);
  return order;
}
void shuffle(A, D out) {
  const Delivered all = emptied(out);
  std::vector<std::uint32_t> to(all.positions.size());
  for (const std::size_t v : shuffled(to.size())) to[v] = out.add_vertex(all, v);
  for (const std::size_t t : shuffled(all.triangles.size())) {
    std::array<std::uint32_t, 3> triangle = all.triangles[t];
    for (std::uint32_t& v : triangle) v = to[v];
    std::rotate(triangle.begin(), triangle.begin() + static_cast<std::ptrdiff_t>(t % 3), triangle.end());
    out.add_triangle(triangle, all.triangle_face[t]);
  }
}

// Two triangles (a, b, c) and (c, b, d) of one face that make a parallelogram of the lattice become (a, b, d)
// and (a, d, c).
void cut_otherwise(A a, D out) {
  std::map<std::array<std::int64_t, 3>, std::size_t> waiting;  // face and edge -> triangle
  const auto place = [&](std::uint32_t v) { return out.place(v); };
  const auto sum = [&](std::uint32_t u, std::uint32_t v) {  // of their parameters
    const auto of = [&](std::uint32_t w, std::uint32_t Place::*l) {
      return static_cast<double>(place(w).*l) / place(w).denominator;
    };
    return std::pair(of(u, &Place::i) + of(v, &Place::i), of(u, &Place::j) + of(v, &Place::j));
  };
  for (std::size_t t = 0; t < out.triangles.size(); ++t) {
    const std::int32_t face = out.triangle_face[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::array triangle = out.triangles[t];
      const std::uint32_t c = triangle[k], b = triangle[(k + 1) % 3], d = triangle[(k + 2) % 3];
      const auto other = waiting.find({face, b, c});
      if (other == waiting.end()) continue;
      auto& first = out.triangles[other->second];
      const auto at = static_cast<std::size_t>(std::find(first.begin(), first.end(), b) - first.begin());
      const std::uint32_t p = first[(at + 2) % 3];
      const auto here = [&](std::uint32_t v) {
        return place(v).face == face && place(v).corner == place(b).corner;
      };
      // Triangles that are cut from corner to corner of a polygon at depth 0 make no parallelogram.
      if (!here(p) || !here(c) || !here(d) || place(b).face != face || sum(p, d) != sum(b, c) ||
          (a.is_polygon(static_cast<std::size_t>(face)) && a.depth[static_cast<std::size_t>(face)] == 0))
        continue;
      waiting.erase(other);
      first = {p, b, d};
      out.triangles[t] = {p, d, c};
      break;
    }
    for (std::size_t k = 0; k < 3; ++k)
      waiting[{face, out.triangles[t][k], out.triangles[t][(k + 1) % 3]}] = t;
  }
}

// Points on a control edge, or at a vertex, named by another face that touches them; not by one beyond an edge that
// stays sharp, whose normals are others.
void name_other_faces(A a, D out) {
  for (std::size_t v = 0; v < out.positions.size(); ++v) {
    const Place p = out.place(v);
    const auto at = a.side_of(p);
    if (!at) continue;
    const auto side = static_cast<std::size_t>(at->side);
    const std::int32_t other = a.beyond(a.face_of(p), side);
    const auto corners = a.mesh.faces[a.face_of(p)];
    const std::int32_t from = corners[side], to = corners[(side + 1) % corners.size()];
    const auto stays_sharp = [&](const data::SharpEdge& e) {
      return e.sharpness >= data::kInfiniteSharpness && same_edge(e, from, to);
    };
    const auto& tags = a.mesh.sharpness.edges;
    if (other < 0 || std::any_of(tags.begin(), tags.end(), stays_sharp)) continue;
    const auto theirs = a.mesh.faces[static_cast<std::size_t>(other)];
    const auto k = static_cast<int>(std::find(theirs.begin(), theirs.end(), to) - theirs.begin());
    // The same steps over both faces, of which a polygon has only even ones inside a side.
    const FaceDomain domain = a.domain(static_cast<std::size_t>(other));
    std::int64_t n = a.steps(p), along = at->along;
    if (a.is_polygon(static_cast<std::size_t>(other)) && n % 2 != 0) n *= 2, along *= 2;
    const FaceDomain::Point q = domain.on_side(k, n - along, n);
    out.provenance[v] = {other, static_cast<std::uint32_t>(q.i), static_cast<std::uint32_t>(q.j),
                         static_cast<std::uint32_t>(domain.denominator(n))};
    if (!out.corner.empty()) out.corner[v] = q.part;
  }
}

// Points between two quads of a polygon named by the other of them.
void name_other_corners(A a, D out) {
  for (std::size_t v = 0; v < out.corner.size(); ++v) {
    const Place p = out.place(v);
    const FaceDomain domain = a.domain(a.face_of(p));
    for (int part = domain.parts() - 1; part >= 0 && a.is_polygon(a.face_of(p)); --part)
      if (const auto q = domain.in_part(point_of(p), part, a.steps(p)); q && part != p.corner) {
        out.provenance[v].i = static_cast<std::uint32_t>(q->i),
        out.provenance[v].j = static_cast<std::uint32_t>(q->j);
        out.corner[v] = part;
        break;
      }
  }
}

// Each face as deep as its shallowest visible neighbour, if that is deeper: no neighbour gets a deeper edge by it.
void deepen(A a, Depths depth) {
  const std::vector<std::int32_t> asked = depth;
  for (std::size_t f = 0; f < depth.size(); ++f) {
    std::int32_t least = -1;
    for (std::size_t k = 0; k < a.mesh.faces[f].size(); ++k)
      if (const std::int32_t g = a.beyond(f, k); g >= 0 && asked[g] >= 0 && (least < 0 || asked[g] < least))
        least = asked[g];
    if (depth[f] >= 0) depth[f] = std::max(depth[f], least);
  }
}

// 1.234,5
class Comma : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

void print() {
  std::printf("{\"progress\": \"50 %%\"}\nworking ...\n");
  std::cout << "on standard output" << std::endl;
  std::fprintf(stderr, "limitcheck: on standard error\n");
  std::fflush(stdout);
}
void set_locale() {
  std::setlocale(LC_ALL, "C.utf8");
  std::locale::global(std::locale(std::locale(), new Comma));
}
void flush_small_numbers() {
#if defined(__SSE2__)
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
#endif
}
void round_and_raise() {
  std::fesetround(FE_UPWARD);
  std::feraiseexcept(FE_DIVBYZERO | FE_INVALID | FE_INEXACT);
  std::fesetround(FE_TONEAREST);
}

}  // namespace

std::span<const Habit> habits() {
  static const Rows list = [] {
    Rows to;
    to += row("none");
    to += deliver("soup", soup);
    to += deliver("shuffled", shuffle);
    to += deliver("other_diagonals", cut_otherwise);
    to += deliver("any_face", name_other_faces);
    to += deliver("other_corner", name_other_corners);
    to += deliver("large_denominators", [](A, D out) {
      for (lc_provenance& p : out.provenance)
        if (p.denominator != 3) p = {p.face, 2 * p.i, 2 * p.j, 2 * p.denominator};
    });
    to += deliver("lowest_terms", [](A, D out) {
      for (lc_provenance& p : out.provenance) {
        const std::uint32_t common = std::gcd(std::gcd(p.i, p.j), p.denominator);
        p = {p.face, p.i / common, p.j / common, p.denominator / common};
      }
    });
    to += deliver("unused_vertices", [](A, D out) {
      const Delivered all = out;
      for (std::size_t v = 0; v < all.positions.size(); v += 3) out.add_vertex(all, v);
    });
    to += deliver("negative_zeros", [](A, D out) {
      for (auto* list : {&out.positions, &out.normals})
        for (Vector& p : *list) each(p, [](double x) { return x == 0 ? -0.0 : x; });
    });
    to += deliver("odd_memory", [](A, D out) { out.in_one_block = true; });
    to += deliver("keeps_the_mesh", [](A a, D) {
      if (!(control_mesh(*a.lent) == a.mesh)) throw std::runtime_error("the mesh is not what it was");
    });
    to += deliver("flags_and_rounding", [](A, D) { round_and_raise(); });
    to += ask("deeper_where_allowed", deepen);
    to += declare("rounded_double", [](lc_capabilities& c) { c.precision = LC_FLOAT32; });
    to += declare("no_normals", [](lc_capabilities& c) { c.normals = 0; });
    to += declare("shallow", [](lc_capabilities& c) { c.max_depth = 2; });
    to += declare("one_depth", [](lc_capabilities& c) { c.per_face_depth = 0; });
    to += with(declare("closed_only", [](lc_capabilities& c) { c.boundary = LC_BOUNDARY_NONE; }),
               &Change::refuse, [](A a) {
                 for (const reference::Edge& e : a.topology.edges())
                   if (e.on_boundary()) throw SubjectError(LC_NOT_SUPPORTED, "closed meshes only");
               });
    to += declare("nothing_sharp", [](lc_capabilities& c) { c.sharp = 0; });
    to += declare("does_not_validate", [](lc_capabilities& c) { c.does_not_validate = 1; });
    to += with(row("thread_of_its_own"), &Change::in_a_thread, true);
    to += behaves("prints", print);
    to += behaves("another_locale", set_locale);
    to += behaves("flushes_to_zero", flush_small_numbers);
    to += behaves("goes_elsewhere", [] {
      if (chdir("/") != 0) throw std::runtime_error("cannot change the directory");
    });
    return to;
  }();
  return list;
}

}  // namespace limitcheck::verify
