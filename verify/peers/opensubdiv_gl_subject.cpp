// SPDX-License-Identifier: MIT
// OpenSubdiv's evaluators for OpenGL: limit stencils, or patches, as compute shaders or by transform feedback. All is
// made as for opensubdiv-far-patches, and the last step done on the device.
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
    return {LC_FLOAT32, LC_WEIGHTS_LOOP, boundary_of(options), LC_POINTS_LIMIT, 10, 1, 1, 0};
  }

  OpenSubdivGlSubject(const lc_mesh& mesh, Options& options)
      : mesh_(mesh), settings_(options), patches_(mesh, boundary_rule(mesh, options), settings_.patches) {}

  void tessellate(const lc_request& request, lc_tessellation& out) {
    const CurrentGl gl;
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
  struct Settings {
    explicit Settings(Options& options)
        : by_patches(options.choice("path", {"stencils", "patches"}) == 1),
          feedback(options.choice("evaluator", {"compute", "xfb"}) == 1),
          patches(patch_options(options)) {}
    bool by_patches, feedback;
    Far::PatchTableFactory::Options patches;
  };

  template <class Evaluator, class StencilTable>
  void run(const FacePatterns& patterns, const Evaluated& to) const {
    void* const kNoContext = nullptr;
    const Osd::BufferDescriptor points(0, 3, 3);
    const auto check = [](bool done) {
      if (!done) throw SubjectError(LC_FAILED, "OpenSubdiv could not make or run its shaders");
    };
    std::vector<float> control(mesh_.positions, mesh_.positions + 3 * mesh_.vertex_count);
    const std::unique_ptr<Evaluator> evaluator(Evaluator::Create(points, points, points, points, kNoContext));
    check(evaluator != nullptr);
    if (patterns.vertices() == 0) return;
    if (!settings_.by_patches) {
      const VertexBuffer from(mesh_.vertex_count);
      from.write(control.data(), control.size() * sizeof control[0]);
      const auto stencils = patches_.limit_stencils<float>(patterns);
      const StencilTable table(static_cast<const Far::LimitStencilTable*>(stencils.get()));
      check(Evaluator::EvalStencils(&from, points, &to.position, points, &to.du, points, &to.dv, points,
                                    &table, evaluator.get()));
      return;
    }
    // The points of all levels, then those of the end caps, by stencils of their own.
    Far::StencilTableFactory::Options options;
    options.generateOffsets = options.generateIntermediateLevels = true;
    std::unique_ptr<const Far::StencilTable> stencils(
        Far::StencilTableFactory::Create(*patches_.refiner, options));
    if (const auto* const local = patches_.table->GetLocalPointStencilTable())
      if (const Far::StencilTable* const all = Far::StencilTableFactory::AppendLocalPointStencilTable(
              *patches_.refiner, stencils.get(), local))
        stencils.reset(all);
    const VertexBuffer from(mesh_.vertex_count + stencils->GetNumStencils());
    from.write(control.data(), control.size() * sizeof control[0]);
    if (stencils->GetNumStencils() > 0) {
      const StencilTable table(stencils.get());
      const Osd::BufferDescriptor behind(static_cast<int>(3 * mesh_.vertex_count), 3, 3);
      const std::unique_ptr<Evaluator> refine(
          Evaluator::Create(points, behind, Osd::BufferDescriptor(), Osd::BufferDescriptor(), kNoContext));
      check(refine != nullptr && Evaluator::EvalStencils(&from, points, &from, behind, &table, refine.get()));
    }
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
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
    const std::unique_ptr<Osd::GLPatchTable> table(Osd::GLPatchTable::Create(patches_.table.get()));
    check(table != nullptr && Evaluator::EvalPatches(&from, points, &to.position, points, &to.du, points,
                                                     &to.dv, points, static_cast<int>(places.size()),
                                                     &coordinates, table.get(), evaluator.get()));
  }

  const lc_mesh mesh_;
  const Settings settings_;
  const OpenSubdivPatches patches_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_opensubdiv_gl() {
  static const lc_subject subject = make_subject<OpenSubdivGlSubject>(
      "opensubdiv-gl", "OpenSubdiv 3.5 on OpenGL: limit stencils or patches, evaluated by shaders",
      "path=stencils|patches (default stencils), evaluator=compute|xfb: compute shaders or transform "
      "feedback (default compute), level=N of isolation (1 to 10, default 2), end-cap=gregory|bspline "
      "(default gregory), boundary=edge|none (default edge; none is the library's: closed meshes only)");
  return lack_of_gl().empty() ? &subject : nullptr;
}
