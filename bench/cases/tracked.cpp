// SPDX-License-Identifier: MIT
#include "bench/cases/tracked.h"

#include <gnu/libc-version.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

#include "bench/cases/matched.h"
#include "bench/cases/shapes.h"
#include "bench/contenders/contender.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "fast/stream/kernel/targets.h"
#include "fast/stream/stream_tessellator.h"
#include "fast/window/tessellator.h"

namespace limitcheck::bench {

namespace {

using Work = std::function<void()>;
namespace rs = fast::row_stream;

std::string depth_name(int depth) {
  return "/depth:" + std::to_string(depth);
}

bool can_be_counted(const std::string& kernel) {
  return kernel.find("avx512") == std::string::npos;
}

/// A mesh made when its case is: the allocations of the others are counted, and depend on what came before.
using Mesh = std::function<data::ControlMesh(Way)>;

Mesh by_faces(const char* shape, int counted, int timed) {
  return [=](Way way) { return mesh_of({shape, way == Way::kCounted ? counted : timed}); };
}

/// The best kernel that is looked at that way.
const rs::Kernel& best(Way way) {
  const auto all = rs::kernels();
  return way == Way::kTimed ? all.front() : *std::find_if(all.begin(), all.end(), [](const rs::Kernel& k) {
    return can_be_counted(k.name);
  });
}

Work run_again_and_again(const Route& route, const data::ControlMesh& mesh, int depth, int threads) {
  std::shared_ptr<Contender> contender = route.make(mesh, depth, threads);
  contender->run();  // first-touch allocations
  return [contender] { contender->run(); };
}

/// The kernels and the other engines, all of a mesh at one depth.
void add_kernels(std::vector<Tracked>& list, const std::vector<Route>& routes, const std::string& prefix,
                 const char* shape, const Mesh& counted, int timed_faces, bool set_up) {
  for (const Route& route : routes) {
    const bool quick = route.nanoseconds_per_point < 10;
    const Shape timed{shape, quick ? timed_faces : timed_faces / 5};
    const auto mesh = [=](Way way) { return way == Way::kCounted ? counted(way) : mesh_of(timed); };
    for (const int depth : {3, 5}) {
      const bool too_slow = route.nanoseconds_per_point > 50 && depth > 3;
      list.push_back({too_slow || !can_be_counted(route.name) ? "" : prefix + route.name + depth_name(depth),
                      full_name(route.name, "steady", timed, depth, 1),
                      [=](Way way) { return run_again_and_again(route, mesh(way), depth, 1); }});
    }
    if (!set_up) continue;
    if (can_be_counted(route.name))
      list.push_back({"set-up/" + prefix + route.name, "",
                      [=](Way way) { return Work{[route, of = mesh(way)] { route.make(of, 3, 1); }}; }});
    list.push_back({"", full_name(route.name, "scratch", timed, 3, 1),
                    [=](Way way) { return Work{[route, of = mesh(way)] { route.make(of, 3, 1)->run(); }}; }});
  }
  // Both threads on the tracker's one core: what they do beside the work, and not how well they overlap.
  const Route& first = routes.front();
  list.push_back({"", full_name(first.name, "steady", {shape, timed_faces}, 5, 2), [=](Way) {
                    return run_again_and_again(first, mesh_of({shape, timed_faces}), 5, 2);
                  }});
}

struct Subject {
  std::string name;  // in front of the case's
  data::Scheme scheme;
  Mesh mesh;
};

std::shared_ptr<rs::StreamTessellator> engine(const data::ControlMesh& mesh, data::Scheme scheme,
                                              const rs::Kernel& kernel, int threads) {
  const fast::TessellatorOptions options{.threads = threads, .scheme = scheme};
  return std::make_shared<rs::StreamTessellator>(mesh, options, kernel);
}

std::vector<std::int32_t> depths(const data::ControlMesh& mesh, bool deeper) {
  std::vector<std::int32_t> depth;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    depth.push_back(static_cast<std::int32_t>(f * 7 % 5) + (deeper && f % 40 == 0 ? 1 : 0));
  return depth;
}

/// Two frames by turns, of depths 0 to 4, by the engine of that kernel or of the best one; in one of them every fortieth
/// face is deeper by one.
///   with   what the output is made with
template <class Output, class... With>
void add_frames(std::vector<Tracked>& list, const Subject& subject, const std::string& form,
                const rs::Kernel* kernel = nullptr, int threads = 1, const With&... with) {
  const bool counted = threads == 1 && (kernel == nullptr || can_be_counted(kernel->name));
  const std::string name = subject.name + "frame/row-stream/" + form;
  list.push_back({counted ? name : "", name, [=](Way way) {
                    const auto mesh = subject.mesh(way);
                    const auto by = engine(mesh, subject.scheme, kernel ? *kernel : best(way), threads);
                    const auto out = std::make_shared<Output>(with...);
                    const auto both = [=, one = depths(mesh, true), other = depths(mesh, false)] {
                      by->frame(one, *out);
                      by->frame(other, *out);
                    };
                    both();
                    return Work{both};
                  }});
}

/// Points that move before each frame, whose depths need cones, or do not.
void add_deforming(std::vector<Tracked>& list, const Subject& subject, fast::Strategy strategy) {
  const std::string name = subject.name + "frame/row-stream/deforming-" + std::string(fast::name(strategy));
  list.push_back({name, name, [=](Way way) {
                    const auto mesh = subject.mesh(way);
                    const auto by = engine(mesh, subject.scheme, best(way), 1);
                    const auto out = std::make_shared<fast::PatchMesh<float>>();
                    const fast::DepthOptions depth{.strategy = strategy};
                    auto moved = mesh.positions;
                    for (auto& p : moved) p[0] *= 1.01;
                    const auto both = [=, still = mesh.positions] {
                      by->move_points(moved), by->frame(depth, fast::Camera{}, *out);
                      by->move_points(still), by->frame(depth, fast::Camera{}, *out);
                    };
                    both();
                    return Work{both};
                  }});
}

/// Every form of output, deforming points, two threads.
void add_all_frames(std::vector<Tracked>& list, const Subject& subject) {
  add_frames<fast::DrawList<float>>(list, subject, "random-depths");
  add_frames<fast::IndexedMesh<float>>(list, subject, "indexed");
  for (const auto& [form, options] :
       {std::pair{"patches", fast::PatchOptions{}},
        std::pair{"patches-kept", fast::PatchOptions{.incremental = true}},
        std::pair{"patches-compact", fast::PatchOptions{.compact = true}},
        std::pair{"patches-sticky", fast::PatchOptions{.incremental = true, .sticky = true}}})
    add_frames<fast::PatchMesh<float>>(list, subject, form, nullptr, 1, options);
  for (const auto strategy : {fast::Strategy::kProjectSphere, fast::Strategy::kCombined})
    add_deforming(list, subject, strategy);
  add_frames<fast::DrawList<float>>(list, subject, "two-threads", nullptr, 2);
}

/// Frames at given depths, again and again.
template <class Real, class Engine>
Work frames_of(const std::shared_ptr<Engine>& by, const std::vector<std::int32_t>& depth) {
  const auto out = std::make_shared<fast::DrawList<Real>>();
  by->frame(depth, *out);
  return [=] { by->frame(depth, *out); };
}

/// The float engine if its points keep the bounds; else the one in double, which is many times slower.
Tracked points_at_equal_error(const Subject& subject) {
  const std::string name = "equal-error/points/" + subject.name + "normals:2^-16";
  return {name, name, [=](Way way) {
            const auto mesh = subject.mesh(way);
            const std::vector<std::int32_t> depth(mesh.faces.size(), 4);
            fast::TessellatorOptions options{.threads = 1, .provenance = true, .scheme = subject.scheme};
            fast::DrawList<float> frame;
            rs::StreamTessellator(mesh, options, best(way)).frame(depth, frame);
            const PointBound worst = worst_errors(mesh, subject.scheme, frame), bound;
            if (worst.position <= bound.position && worst.normal <= bound.normal)
              return frames_of<float>(engine(mesh, subject.scheme, best(way), 1), depth);
            options.provenance = false;
            return frames_of<double>(std::make_shared<fast::Tessellator<double>>(mesh, options), depth);
          }};
}

/// project-sphere, as fine as half a pixel for 99 % of the pixels wants it.
Tracked frames_at_equal_error(const Subject& subject) {
  const std::string name = "equal-error/frames/" + subject.name + "pixels:0.5";
  return {name, name, [=](Way way) {
            const auto mesh = subject.mesh(way);
            const auto by = engine(mesh, subject.scheme, best(way), 1);
            rs::StreamTessellator judged(mesh, {.provenance = true, .scheme = subject.scheme}, best(way));
            const fast::Camera camera;
            fast::DepthOptions depth{.strategy = fast::Strategy::kProjectSphere};
            const double target = matching_target(.5, [&](double pixels) {
              fast::DrawList<float> frame;
              depth.target_pixels = pixels;
              judged.frame(depth, camera, frame);
              return pixel_error(mesh, subject.scheme, camera, frame);
            });
            depth.target_pixels = target > 0 ? target : 1. / 64;
            const auto out = std::make_shared<fast::DrawList<float>>();
            by->frame(depth, camera, *out);
            return Work{[=] { by->frame(depth, camera, *out); }};
          }};
}

}  // namespace

std::string build_identity() {
  return std::string(LIMITCHECK_COMPILER_ID) + "/glibc-" + gnu_get_libc_version() + "/" + LIMITCHECK_FLAGS;
}

std::vector<Tracked> tracked_cases() {
  std::vector<Tracked> list;
  constexpr auto kLoop = data::Scheme::kLoop, kQuads = data::Scheme::kCatmullClark;
  const Mesh pawn = [](Way) { return data::pawn(12); };  // valences 3, 4 and 12
  const Subject triangles{"", kLoop, by_faces("bumpy", 200, 1000)},
      quads{"quads/", kQuads,
            [=](Way way) {
              return way == Way::kCounted ? pawn(way) : mesh_of({"quads", 1002});
            }},
      regular{"regular/", kQuads, by_faces("regular", 200, 1000)},
      torus{"torus/", kLoop, by_faces("torus", 200, 1000)},
      polygons{"n-gons/", kQuads, [](Way way) { return data::mixed_pawn(way == Way::kCounted ? 8 : 24); }},
      semi_sharp{"semi-sharp/", kQuads, [](Way) { return data::crease_ring(2, 5); }};

  add_kernels(list, our_routes(), "", "bumpy", triangles.mesh, 1000, true);
  std::vector<Route> regular_routes = our_routes();
  std::erase_if(regular_routes, [](const Route& route) { return !route.name.starts_with("row-stream/"); });
  add_kernels(list, regular_routes, "torus/", "torus", torus.mesh, 1000, false);
  add_kernels(list, our_quad_routes(), "quads/", "quads", pawn, 1002, true);
  add_kernels(list, our_quad_routes(), "regular/", "regular", regular.mesh, 1000, false);
  for (const Route& route : our_quad_routes()) {
    if (!route.name.starts_with("row-stream/")) continue;
    for (const int depth : {1, 3}) {  // at depth 1 sides are half of the work
      const std::string name = "quads/semi-sharp/" + route.name + (depth == 3 ? "" : depth_name(depth));
      list.push_back({can_be_counted(route.name) ? name : "", name,
                      [=](Way way) { return run_again_and_again(route, semi_sharp.mesh(way), depth, 1); }});
    }
  }

  for (const Subject* subject : {&triangles, &quads}) add_all_frames(list, *subject);
  for (const Subject* subject : {&polygons, &semi_sharp})
    add_frames<fast::PatchMesh<float>>(list, *subject, "patches");
  for (const rs::Kernel& kernel : rs::kernels())
    for (const Subject* subject : {&triangles, &torus, &quads, &regular})
      add_frames<fast::DrawList<float>>(list, *subject, std::string(kernel.name) + "/random-depths", &kernel);

  const Subject small{"", kLoop, by_faces("bumpy", 200, 200)},
      small_quads{"quads/", kQuads, [](Way) { return data::pawn(8); }};
  for (const Subject* subject : {&small, &small_quads}) {
    list.push_back(points_at_equal_error(*subject));
    list.push_back(frames_at_equal_error(*subject));
  }
  return list;
}

}  // namespace limitcheck::bench
