// SPDX-License-Identifier: MIT
// OpenSubdiv's tessellation shaders: its vertex, control and evaluation sections, with equal levels on all faces, drawn
// and captured. What OpenSubdiv leaves to its clients, the matrices, is the identity. Private to the adapter.
#pragma once

#include <epoxy/gl.h>

#include <opensubdiv/osd/glPatchTable.h>
#include <opensubdiv/osd/glslPatchShaderSource.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "verify/gl/compute.h"
#include "verify/peers/opensubdiv_mesh.h"

namespace limitcheck::verify {

/// Of the 64 steps that every device has: 2^6.
inline constexpr int kDeepestOpenSubdivTessellation = 6;

/// What the evaluation shader says of a vertex. Three in a row are a triangle.
struct OpenSubdivTessellated {
  struct {
    float x, y, z, w;
  } position;
  struct {
    float x, y, z;
  } normal;
  float u, v, level, ptex_face;  // of the ptex face; 1/2 is added to the last two
};

/// The program of patches of one type: compiled once, and there until the process ends.
inline const GlProgram& opensubdiv_patch_program(OpenSubdiv::Far::PatchDescriptor::Type type) {
  using Source = OpenSubdiv::Osd::GLSLPatchShaderSource;
  static auto& made = *new std::map<int, std::unique_ptr<GlProgram>>;
  auto& program = made[type];
  if (program == nullptr) {
    const std::string common = "#version 450 core\n#define OSD_PATCH_BASIS_GLSL\n" +
                               Source::GetPatchBasisShaderSource() + Source::GetCommonShaderSource() + R"(
uniform int lc_first_patch, lc_steps;
mat4 OsdModelViewMatrix() { return mat4(1); }
mat4 OsdProjectionMatrix() { return mat4(1); }
mat4 OsdModelViewProjectionMatrix() { return mat4(1); }
float OsdTessLevel() { return 0.5 * float(lc_steps); }  // OpenSubdiv counts from the first refined faces
int OsdGregoryQuadOffsetBase() { return 0; }
int OsdPrimitiveIdBase() { return lc_first_patch; }
int OsdBaseVertex() { return 0; }
)";
    program = std::make_unique<GlProgram>(
        std::vector<GlProgram::Stage>{
            {GL_VERTEX_SHADER, common + Source::GetVertexShaderSource(type)},
            {GL_TESS_CONTROL_SHADER, common + Source::GetTessControlShaderSource(type)},
            {GL_TESS_EVALUATION_SHADER, common + Source::GetTessEvalShaderSource(type)}},
        "OpenSubdiv's shaders",
        std::vector<const char*>{"block.v.position", "block.v.normal", "block.v.patchCoord"});
  }
  return *program;
}

/// All patches of a table, each face in so many steps to a side.
///   points   three floats each: of the control mesh, of all levels, and of the end caps
inline std::vector<OpenSubdivTessellated> tessellate_patches(const OpenSubdiv::Osd::GLPatchTable& table,
                                                             const GuardedBuffer& points, int steps) {
  GLint bound = 0;
  GLuint array = 0;
  glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &bound);
  glCreateVertexArrays(1, &array);
  glEnableVertexArrayAttrib(array, 0);
  glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayVertexBuffer(array, 0, points.name(), 0, 3 * sizeof(float));
  glVertexArrayElementBuffer(array, table.GetPatchIndexBuffer());
  glBindVertexArray(array);
  glBindTextureUnit(0, table.GetPatchParamTextureBuffer());
  std::vector<OpenSubdivTessellated> all;
  for (const OpenSubdiv::Osd::PatchArray& patches : table.GetPatchArrays()) {
    const GlProgram& program = opensubdiv_patch_program(patches.GetDescriptor().GetType());
    program.use();
    program.set("lc_steps", steps);
    const std::vector<std::int32_t> words = captured_patches(
        program,
        {patches.GetNumPatches(), patches.GetPrimitiveIdBase(), patches.GetStride(), patches.GetIndexBase()},
        sizeof(OpenSubdivTessellated) / sizeof(std::int32_t));
    const std::size_t before = all.size(), bytes = words.size() * sizeof words[0];
    all.resize(before + bytes / sizeof all[0]);
    if (bytes > 0) std::memcpy(all.data() + before, words.data(), bytes);
  }
  glBindTextureUnit(0, 0);
  glBindVertexArray(static_cast<GLuint>(bound));
  glDeleteVertexArrays(1, &array);
  return all;
}

}  // namespace limitcheck::verify
