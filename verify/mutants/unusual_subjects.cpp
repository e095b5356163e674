// SPDX-License-Identifier: MIT
#include "verify/mutants/unusual_subjects.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cfenv>
#include <chrono>
#include <clocale>
#include <cstdio>
#include <iostream>
#include <locale>
#include <map>
#include <memory>
#include <new>
#include <thread>
#include <utility>
#include <vector>

#if defined(__SSE2__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

#include "verify/host/host.h"
#include "verify/mutants/unusual_delivery.h"
#include "verify/subject/adapter.h"
#include "verify/subject/control_mesh.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

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

void flush_small_numbers() {
#if defined(__SSE2__)
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
#endif
}

class UnusualSubject {
 public:
  static lc_capabilities capabilities(Options& options) {
    const Inner inner(options);
    if (inner.habit == "prints") print();
    lc_capabilities c = verify::capabilities(inner.subject, inner.options);
    if (inner.habit == "rounded_double") c.precision = LC_FLOAT32;
    if (inner.habit == "no_normals") c.normals = 0;
    if (inner.habit == "shallow") c.max_depth = 2;
    if (inner.habit == "closed_only") c.boundary = LC_BOUNDARY_NONE;
    if (inner.habit == "one_depth") c.per_face_depth = 0;
    return c;
  }

  UnusualSubject(const lc_mesh& mesh, Options& options) : UnusualSubject(mesh, Inner(options)) {}

  void tessellate(const lc_request& request, lc_tessellation& out) {
    behave();
    if (is("keeps_the_mesh") && !(control_mesh(*lent_) == session_.mesh()))
      throw std::runtime_error("the mesh is not what it was");
    if (session_.capabilities().precision == LC_FLOAT32 || is("rounded_double"))
      run<float>(request, out);
    else
      run<double>(request, out);
  }

 private:
  // What the options say: the habit, the subject that has it, and the options for that one.
  struct Inner {
    explicit Inner(Options& given)
        : habit(names()[given.choice("habit", names())]),
          subject(find(given.value("of", "null"))),
          options(given.rest()) {}

    static std::vector<std::string_view> names() {
      std::vector<std::string_view> list;
      for (const Habit& h : habits()) list.push_back(h.name);
      return list;
    }

    static const lc_subject& find(const std::string& name) {
      const lc_subject* subject = find_subject(name);
      if (subject == nullptr || subject == lc_subject_unusual())
        throw SubjectError(LC_INVALID_INPUT, fmt::format("option of={}: there is no such subject", name));
      return *subject;
    }

    std::string_view habit;
    const lc_subject& subject;
    std::string options;
  };

  UnusualSubject(const lc_mesh& mesh, const Inner& inner)
      : habit_(inner.habit), lent_(&mesh), session_(inner.subject, control_mesh(mesh), inner.options) {
    behave();
    if (is("closed_only")) refuse_boundaries();
  }

  bool is(std::string_view habit) const { return habit_ == habit; }

  // What has nothing to do with tessellating.
  void behave() const {
    using namespace std::chrono_literals;
    if (is("prints")) print();
    if (is("slow")) std::this_thread::sleep_for(5ms);
    if (is("flushes_to_zero")) flush_small_numbers();
    if (is("goes_elsewhere") && chdir("/") != 0) throw std::runtime_error("cannot change the directory");
    if (is("another_locale")) {
      std::setlocale(LC_ALL, "C.utf8");
      std::locale::global(std::locale(std::locale(), new Comma));
    }
  }

  void refuse_boundaries() const {
    std::vector<std::pair<std::int32_t, std::int32_t>> edges;
    for (const auto& t : triangles_of(session_.mesh()))
      for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
    std::sort(edges.begin(), edges.end());
    for (const auto& [a, b] : edges)
      if (!std::binary_search(edges.begin(), edges.end(), std::pair(b, a)))
        throw SubjectError(LC_NOT_SUPPORTED, "closed meshes only");
  }

  // Each face as deep as its shallowest neighbour, if that is deeper: no neighbour gets a deeper edge by it.
  std::vector<std::int32_t> deeper(const std::vector<std::int32_t>& asked) const {
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> face_of;
    const auto& triangles = triangles_of(session_.mesh());
    for (std::size_t f = 0; f < triangles.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) face_of[{triangles[f][k], triangles[f][(k + 1) % 3]}] = f;
    std::vector<std::int32_t> depth = asked;
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      std::int32_t least = -1;  // among the visible neighbours
      for (std::size_t k = 0; k < 3; ++k) {
        const auto beyond = face_of.find({triangles[f][(k + 1) % 3], triangles[f][k]});
        const std::int32_t d = beyond == face_of.end() ? -1 : asked[beyond->second];
        if (d >= 0 && (least < 0 || d < least)) least = d;
      }
      if (depth[f] >= 0) depth[f] = std::max(depth[f], least);
    }
    return depth;
  }

  template <class Real>
  void run(const lc_request& request, lc_tessellation& out) {
    std::vector<std::int32_t> depth(request.face_depth, request.face_depth + session_.mesh().faces.size());
    if (is("deeper_where_allowed")) depth = deeper(depth);
    DeliveredCopy<Real> copy;
    const auto work = [&] {
      copy = copy_of<Real>(session_.tessellate(depth, request.threads));
      if (is("no_normals")) copy.normals.clear();
      rearrange(habit_, session_.mesh(), copy);
    };
    if (is("thread_of_its_own")) {
      std::exception_ptr error;
      std::thread([&] {
        try {
          work();
        } catch (...) {
          error = std::current_exception();
        }
      }).join();
      if (error) std::rethrow_exception(error);
    } else {
      work();
    }
    if (is("flags_and_rounding")) {
      std::fesetround(FE_UPWARD);
      std::feraiseexcept(FE_DIVBYZERO | FE_INVALID | FE_INEXACT);
      std::fesetround(FE_TONEAREST);
    }
    deliver(copy, request, out);
  }

  template <class Real>
  void deliver(const DeliveredCopy<Real>& copy, const lc_request& request, lc_tessellation& out) const {
    const auto vertices = static_cast<std::int64_t>(copy.positions.size());
    const auto triangles = static_cast<std::int64_t>(copy.triangles.size());
    const bool normals = !copy.normals.empty();
    if (!is("odd_memory")) {
      fill(allocate_output<Real>(request, out, vertices, triangles, normals), copy);
      return;
    }
    // The arrays from last to first, as parts of one block that begins and ends with something else.
    constexpr std::size_t kRoom = 64;
    const auto places = [&](std::size_t bytes) { return (bytes + 2 * kRoom) / kRoom * kRoom; };
    const std::size_t points = places(static_cast<std::size_t>(vertices) * 3 * sizeof(Real));
    const std::size_t indices = places(static_cast<std::size_t>(triangles) * 3 * sizeof(std::uint32_t));
    const std::size_t named = places(static_cast<std::size_t>(vertices) * sizeof(lc_provenance));
    (void)request.allocate(request.host, 0);
    auto* block =
        static_cast<char*>(request.allocate(request.host, 2 * points + 2 * indices + named + 2 * kRoom));
    if (block == nullptr) throw std::bad_alloc();
    char* at = block + kRoom;
    const auto take = [&](std::size_t bytes) { return static_cast<void*>(std::exchange(at, at + bytes)); };
    out.vertex_count = vertices;
    out.triangle_count = triangles;
    out.triangle_face = static_cast<std::int32_t*>(take(indices));
    out.triangles = static_cast<std::uint32_t*>(take(indices));
    out.provenance = static_cast<lc_provenance*>(take(named));
    out.normals = normals ? take(points) : nullptr;
    out.positions = take(points);
    fill(Output<Real>{static_cast<Real*>(out.positions), static_cast<Real*>(out.normals), out.provenance,
                      out.triangles, out.triangle_face},
         copy);
  }

  const std::string_view habit_;
  const lc_mesh* const lent_;
  Session session_;
};

}  // namespace

std::span<const Habit> habits() {
  static const std::vector<Habit> list{
      {"none", "none: the subject as it is"},
      {"soup", "every triangle has vertices of its own"},
      {"shuffled", "vertices and triangles in any order, triangles begun at any corner"},
      {"other_diagonals", "inner rhombi are cut along the other diagonal"},
      {"any_face", "points of edges and corners are named by another face that touches them"},
      {"large_denominators", "fractions are not in lowest terms, nor of the depth: 2 i / 2 n"},
      {"unused_vertices", "a third of the vertices is there twice, and no triangle uses the second one"},
      {"negative_zeros", "zeros are negative"},
      {"deeper_where_allowed", "faces are deeper than asked for where all their neighbours are"},
      {"rounded_double", "computes in double and delivers float"},
      {"odd_memory", "all arrays are parts of one block, in another order, with room between"},
      {"keeps_the_mesh", "keeps no copy of the control mesh: reads what it was lent each time"},
      {"no_normals", "delivers no normals, and says so"},
      {"shallow", "to depth 2 only, and says so"},
      {"closed_only", "closed meshes only, and says so"},
      {"one_depth", "one depth for all faces only, and says so"},
      {"thread_of_its_own", "computes in a thread of its own"},
      {"slow", "takes its time"},
      {"prints", "prints to standard output and standard error", true},
      {"another_locale", "sets a locale with decimal commas, and leaves it set", true},
      {"flushes_to_zero", "has the processor flush small numbers to zero, and leaves it so", true},
      {"flags_and_rounding", "uses another rounding mode, and leaves exception flags raised", true},
      {"goes_elsewhere", "changes the working directory", true},
  };
  return list;
}

std::string unusual_options(std::string_view habit, std::string_view subject, std::string_view options) {
  return fmt::format("habit={},of={}{}{}", habit, subject, options.empty() ? "" : ",", options);
}

}  // namespace limitcheck::verify

extern "C" const lc_subject* lc_subject_unusual() {
  using limitcheck::verify::UnusualSubject;
  static const lc_subject subject = limitcheck::verify::make_subject<UnusualSubject>(
      "unusual", "another subject with a habit that is rare and right: what no check may blame",
      "of=SUBJECT, habit=NAME (default none), and the options of that subject");
  return &subject;
}
