// SPDX-License-Identifier: MIT
// Habits that are rare but allowed by subject.h: a name, what it is, and a function that does it.
#include <unistd.h>

#include <cfenv>
#include <chrono>
#include <clocale>
#include <cstdio>
#include <iostream>
#include <locale>
#include <map>
#include <numeric>
#include <thread>

#if defined(__SSE2__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

#include "data/splitmix64.h"
#include "verify/mutants/change_rows.h"

namespace limitcheck::verify {

using namespace rows;

namespace {

Change habit(const char* name, const char* description) {
  return on(On::kBoth, row(name, description, ""));
}
Change delivered(const char* name, const char* description, std::function<void(A, D)> what) {
  return on(On::kBoth, deliver(name, description, "", std::move(what)));
}
Change declared(const char* name, const char* description, std::function<void(lc_capabilities&)> what) {
  return with(habit(name, description), &Change::declare, std::move(what));
}
Change behaves(const char* name, const char* description, std::function<void()> what,
               bool of_the_process = true) {
  return with(with(habit(name, description), &Change::behave, std::move(what)), &Change::of_the_process,
              of_the_process);
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
void reorder(D out, const std::vector<std::size_t>& vertices, const std::vector<std::size_t>& triangles) {
  const Delivered all = emptied(out);
  std::vector<std::uint32_t> to(all.positions.size());
  for (const std::size_t v : vertices) to[v] = out.add_vertex(all, v);
  for (const std::size_t t : triangles) {
    std::array<std::uint32_t, 3> triangle = all.triangles[t];
    for (std::uint32_t& v : triangle) v = to[v];
    std::rotate(triangle.begin(), triangle.begin() + static_cast<std::ptrdiff_t>(t % 3), triangle.end());
    out.add_triangle(triangle, all.triangle_face[t]);
  }
}
void shuffle(A, D out) {
  reorder(out, shuffled(out.positions.size()), shuffled(out.triangles.size()));
}
void reverse(A, D out) {
  std::vector<std::size_t> vertices(out.positions.size()), triangles(out.triangles.size());
  std::iota(vertices.rbegin(), vertices.rend(), 0);
  std::iota(triangles.rbegin(), triangles.rend(), 0);
  reorder(out, vertices, triangles);
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

std::vector<Change> all_habits() {
  return {
      habit("none", "none: the subject as it is"),
      delivered("soup", "every triangle has vertices of its own", soup),
      delivered("shuffled", "vertices and triangles in any order, triangles begun at any corner", shuffle),
      delivered("reversed", "vertices and triangles from last to first", reverse),
      delivered("other_diagonals", "inner rhombi are cut along the other diagonal", cut_otherwise),
      delivered("any_face", "points of edges and corners are named by another face that touches them",
                name_other_faces),
      delivered("other_corner", "points between two quads of a face that is none are named by the other",
                name_other_corners),
      delivered("large_denominators", "fractions are not in lowest terms, nor of the depth: 2 i / 2 n",
                [](A, D out) {
                  for (lc_provenance& p : out.provenance)
                    if (p.denominator != 3) p = {p.face, 2 * p.i, 2 * p.j, 2 * p.denominator};
                }),
      delivered("lowest_terms", "fractions are in lowest terms",
                [](A, D out) {
                  for (lc_provenance& p : out.provenance) {
                    const std::uint32_t common = std::gcd(std::gcd(p.i, p.j), p.denominator);
                    p = {p.face, p.i / common, p.j / common, p.denominator / common};
                  }
                }),
      delivered("unused_vertices",
                "a third of the vertices is there twice, and no triangle uses the second one",
                [](A, D out) {
                  const Delivered all = out;
                  for (std::size_t v = 0; v < all.positions.size(); v += 3) out.add_vertex(all, v);
                }),
      delivered("large_indices", "triangles use the last copy of eight of each vertex: indices are large",
                [](A, D out) {
                  const Delivered all = out;
                  const auto count = static_cast<std::uint32_t>(all.positions.size());
                  for (int copy = 1; copy < 8; ++copy)
                    for (std::size_t v = 0; v < count; ++v) out.add_vertex(all, v);
                  for (auto& triangle : out.triangles)
                    for (std::uint32_t& v : triangle) v += 7 * count;
                }),
      delivered("negative_zeros", "zeros are negative",
                [](A, D out) {
                  for (auto* list : {&out.positions, &out.normals})
                    for (Vector& p : *list) each(p, [](double x) { return x == 0 ? -0.0 : x; });
                }),
      delivered("odd_memory", "all arrays are parts of one block, in another order, with room between",
                [](A, D out) { out.in_one_block = true; }),
      delivered("keeps_the_mesh", "keeps no copy of the control mesh: reads what it was lent each time",
                [](A a, D) {
                  if (!(control_mesh(*a.lent) == a.mesh))
                    throw std::runtime_error("the mesh is not what it was");
                }),
      with(delivered("flags_and_rounding", "uses another rounding mode, and leaves exception flags raised",
                     [](A, D) { round_and_raise(); }),
           &Change::of_the_process, true),
      on(On::kBoth, ask("deeper_where_allowed",
                        "faces are deeper than asked for where all their neighbours are", "", deepen)),
      declared("rounded_double", "computes in double and delivers float",
               [](lc_capabilities& c) { c.precision = LC_FLOAT32; }),
      declared("no_normals", "delivers no normals, and says so", [](lc_capabilities& c) { c.normals = 0; }),
      declared("shallow", "to depth 2 only, and says so", [](lc_capabilities& c) { c.max_depth = 2; }),
      declared("one_depth", "one depth for all faces only, and says so",
               [](lc_capabilities& c) { c.per_face_depth = 0; }),
      with(declared("closed_only", "closed meshes only, and says so",
                    [](lc_capabilities& c) { c.boundary = LC_BOUNDARY_NONE; }),
           &Change::refuse,
           [](A a) {
             for (const reference::Edge& e : a.topology.edges())
               if (e.on_boundary()) throw SubjectError(LC_NOT_SUPPORTED, "closed meshes only");
           }),
      declared("nothing_sharp", "no sharp edges or vertices, and says so",
               [](lc_capabilities& c) { c.sharp = 0; }),
      declared("does_not_validate", "relies on its callers to hand over valid meshes, and says so",
               [](lc_capabilities& c) { c.does_not_validate = 1; }),
      with(habit("thread_of_its_own", "computes in a thread of its own"), &Change::in_a_thread, true),
      behaves(
          "slow", "takes its time", [] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); },
          /*of_the_process=*/false),
      behaves("prints", "prints to standard output and standard error", print),
      behaves("another_locale", "sets a locale with decimal commas, and leaves it set", set_locale),
      behaves("flushes_to_zero", "has the processor flush small numbers to zero, and leaves it so",
              flush_small_numbers),
      behaves("goes_elsewhere", "changes the working directory",
              [] {
                if (chdir("/") != 0) throw std::runtime_error("cannot change the directory");
              }),
  };
}

}  // namespace

std::span<const Habit> habits() {
  static const std::vector<Habit> list = all_habits();
  return list;
}

}  // namespace limitcheck::verify
