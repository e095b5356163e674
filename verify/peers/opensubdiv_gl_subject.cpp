// SPDX-License-Identifier: MIT
// OpenSubdiv's evaluators for OpenGL: limit stencils, or patches, as compute shaders or by transform feedback; and its
// tessellation shaders. All is made as for opensubdiv-far-patches, and the last step done on the device.
#include <epoxy/gl.h>

#include <opensubdiv/osd/bufferDescriptor.h>
#include <opensubdiv/osd/glComputeEvaluator.h>
#include <opensubdiv/osd/glPatchTable.h>
#include <opensubdiv/osd/glXFBEvaluator.h>
#include <opensubdiv/osd/types.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "verify/gl/compute.h"
#include "verify/gl/context.h"
#include "verify/peers/opensubdiv_gl_tessellation.h"
#include "verify/peers/opensubdiv_patches.h"
#include "verify/subject/devices.h"
#include "verify/subject/registry.h"
#include "verify/subject/written_outside.h"

namespace {

using namespace limitcheck::verify;
namespace Far = OpenSubdiv::Far;
namespace Osd = OpenSubdiv::Osd;

// What OpenSubdiv's evaluators take for a buffer of vertices.
class VertexBuffer : public GuardedBuffer {
 public:
  explicit VertexBuffer(std::int64_t vertices, std::size_t size = 12)
      : GuardedBuffer(static_cast<std::size_t>(vertices) * size) {}
  GLuint BindVBO() const { return name(); }
};

// The points of one face after another as the device left them, and what it wrote behind.
class Evaluated {
 public:
  explicit Evaluated(std::int64_t count) : position(count), du(count), dv(count) {}
  VertexBuffer position, du, dv;

  void deliver(const lc_mesh& mesh, const FacePatterns& patterns, const lc_request& request,
               lc_tessellation& out) const {
    const auto p = position.read(), u = du.read(), v = dv.read();
    const auto floats = [](const auto& bytes) { return reinterpret_cast<const float*>(bytes.data()); };
    const PointsInOrder<float> points(patterns, {floats(p), floats(u), floats(v)});
    tessellate_faces<float>(mesh, patterns, request, out, [&] { return points; });
    const std::size_t size = position.size();
    if (p.size() > size) show_written_behind(static_cast<std::byte*>(out.positions) + size, p.size() - size);
    if (const std::size_t far = std::max(u.size(), v.size()); far > size)
      show_written_behind(static_cast<std::byte*>(out.normals) + size, far - size);
  }
};

class OpenSubdivGlSubject {
 public:
  static constexpr std::int32_t kSharp = kOpenSubdivSharp;

  static lc_capabilities capabilities(Options& options, lc_scheme) {
    const Settings settings(options);
    const CurrentGl there_is_one;
    Devices::note("opensubdiv-gl", gl_device());
    lc_capabilities c{LC_FLOAT32, LC_WEIGHTS_LOOP, boundary_of(options), LC_POINTS_LIMIT, 10, 1, 1, 0};
    if (settings.path == kTessellation) {
      c.max_depth = kDeepestOpenSubdivTessellation;
      c.per_face_depth = 0;  // OpenSubdiv's uniform level is one for all
      c.points_anywhere = 1;
    }
    return c;
  }

  OpenSubdivGlSubject(const lc_mesh& mesh, Options& options)
      : mesh_(mesh), settings_(options), patches_(mesh, boundary_rule(mesh, options), settings_.patches) {}

  void tessellate(const lc_request& request, lc_tessellation& out) {
    const CurrentGl gl;
    if (settings_.path == kTessellation) return tessellate_on_device(request, out);
    const FacePatterns patterns(mesh_, request, opensubdiv_triangle);
    const Evaluated evaluated(patterns.vertices());
    if (settings_.feedback)
      run<Osd::GLXFBEvaluator, Osd::GLStencilTableTBO>(patterns, evaluated);
    else
      run<Osd::GLComputeEvaluator, Osd::GLStencilTableSSBO>(patterns, evaluated);
    // The library asks for no error, and says that all went well: what it left is judged.
    while (glGetError() != GL_NO_ERROR) {
    }
    evaluated.deliver(mesh_, patterns, request, out);
  }

 private:
  enum Path : std::uint8_t { kStencils, kPatches, kTessellation };
  struct Settings {
    explicit Settings(Options& options)
        : path(static_cast<Path>(options.choice("path", {"stencils", "patches", "tess"}))),
          feedback(options.choice("evaluator", {"compute", "xfb"}) == 1),
          patches(patch_options(options)) {}
    Path path;
    bool feedback;
    Far::PatchTableFactory::Options patches;
  };

  static void check(bool done) {
    if (!done) throw SubjectError(LC_FAILED, "OpenSubdiv could not make or run its shaders");
  }

  // The points of the control mesh, of all levels and of the end caps, which patches name: by stencils of their own.
  template <class Evaluator, class StencilTable>
  VertexBuffer points_of_patches() const {
    Far::StencilTableFactory::Options options;
    options.generateOffsets = options.generateIntermediateLevels = true;
    std::unique_ptr<const Far::StencilTable> stencils(
        Far::StencilTableFactory::Create(*patches_.refiner, options));
    if (const auto* const local = patches_.table->GetLocalPointStencilTable())
      if (const Far::StencilTable* const all = Far::StencilTableFactory::AppendLocalPointStencilTable(
              *patches_.refiner, stencils.get(), local))
        stencils.reset(all);
    VertexBuffer points(mesh_.vertex_count + stencils->GetNumStencils());
    points.write(control_.data(), control_.size() * sizeof control_[0]);
    if (stencils->GetNumStencils() > 0) {
      const Osd::BufferDescriptor front(0, 3, 3), behind(static_cast<int>(3 * mesh_.vertex_count), 3, 3),
          none;
      // An evaluator is what loads OpenGL's functions for the library: before its tables.
      const std::unique_ptr<Evaluator> refine(Evaluator::Create(front, behind, none, none, kNoContext));
      check(refine != nullptr);
      const StencilTable table(stencils.get());
      check(Evaluator::EvalStencils(&points, front, &points, behind, &table, refine.get()));
    }
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    return points;
  }
  std::unique_ptr<const Osd::GLPatchTable> device_patches() const {
    std::unique_ptr<const Osd::GLPatchTable> table(Osd::GLPatchTable::Create(patches_.table.get()));
    check(table != nullptr);
    return table;
  }

  void tessellate_on_device(const lc_request& request, lc_tessellation& out) const {
    const VertexBuffer points = settings_.feedback
                                    ? points_of_patches<Osd::GLXFBEvaluator, Osd::GLStencilTableTBO>()
                                    : points_of_patches<Osd::GLComputeEvaluator, Osd::GLStencilTableSSBO>();
    std::vector<std::array<std::int32_t, 2>> face_and_part;
    for (std::int32_t f = 0; f < mesh_.face_count; ++f) {
      const bool cut = mesh_.scheme == LC_SCHEME_CATMULL_CLARK && mesh_.face_sizes[f] != 4;
      for (std::int32_t part = 0; part < (cut ? mesh_.face_sizes[f] : 1); ++part)
        face_and_part.push_back({f, part});
    }
    DeliveredArrays made;
    for (const OpenSubdivTessellated& v :
         tessellate_patches(*device_patches(), points, 1 << uniform_depth(request, mesh_))) {
      const auto [face, part] = face_and_part.at(static_cast<std::size_t>(v.ptex_face));
      const auto number = made.add_vertex(v.position, v.normal, nearest_place(face, v.u, v.v), part);
      if (number % 3 == 2) made.add_triangle({number - 2, number - 1, number}, face);
    }
    made.hand_over<float>(request, out, true, mesh_.scheme == LC_SCHEME_CATMULL_CLARK);
  }

  template <class Evaluator, class StencilTable>
  void run(const FacePatterns& patterns, const Evaluated& to) const {
    const Osd::BufferDescriptor points(0, 3, 3);
    const std::unique_ptr<Evaluator> evaluator(Evaluator::Create(points, points, points, points, kNoContext));
    check(evaluator != nullptr);
    if (patterns.vertices() == 0) return;
    if (settings_.path == kStencils) {
      const VertexBuffer from(mesh_.vertex_count);
      from.write(control_.data(), control_.size() * sizeof control_[0]);
      const auto stencils = patches_.limit_stencils<float>(patterns);
      const StencilTable table(static_cast<const Far::LimitStencilTable*>(stencils.get()));
      check(Evaluator::EvalStencils(&from, points, &to.position, points, &to.du, points, &to.dv, points,
                                    &table, evaluator.get()));
      return;
    }
    const VertexBuffer from = points_of_patches<Evaluator, StencilTable>();
    std::vector<Osd::PatchCoord> places;
    for (std::int64_t f = 0; f < patterns.faces(); ++f)
      if (const FacePattern* const pattern = patterns.of(f).pattern; pattern != nullptr)
        for (const FaceDomain::Point& p : pattern->points) {
          const auto denominator = static_cast<float>(pattern->denominator);
          const float uv[2] = {static_cast<float>(p.i) / denominator, static_cast<float>(p.j) / denominator};
          places.emplace_back(patches_.patch(static_cast<std::int32_t>(f), p.part, uv), uv[0], uv[1]);
        }
    const VertexBuffer coordinates(patterns.vertices(), sizeof(Osd::PatchCoord));
    coordinates.write(places.data(), places.size() * sizeof places[0]);
    const auto table = device_patches();
    check(Evaluator::EvalPatches(&from, points, &to.position, points, &to.du, points, &to.dv, points,
                                 static_cast<int>(places.size()), &coordinates, table.get(),
                                 evaluator.get()));
  }

  static constexpr void* kNoContext = nullptr;
  const lc_mesh mesh_;
  const std::vector<float> control_{mesh_.positions, mesh_.positions + 3 * mesh_.vertex_count};
  const Settings settings_;
  const OpenSubdivPatches patches_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_opensubdiv_gl() {
  static const lc_subject subject = make_subject<OpenSubdivGlSubject>(
      "opensubdiv-gl",
      "OpenSubdiv 3.5 on OpenGL: limit stencils or patches by shaders, or tessellation shaders",
      "path=stencils|patches|tess (default stencils; tess: tessellation shaders, points off the lattice), "
      "evaluator=compute|xfb: compute shaders or transform "
      "feedback (default compute), level=N of isolation (1 to 10, default 2), end-cap=gregory|bspline "
      "(default gregory), boundary=edge|none (default edge; none is the library's: closed meshes only)");
  return lack_of_gl().empty() ? &subject : nullptr;
}
