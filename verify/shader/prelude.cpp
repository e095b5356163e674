// SPDX-License-Identifier: MIT
#include "verify/shader/prelude.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "data/sharpness.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::verify {

namespace {

constexpr const char* kMesh = R"(
layout(std430, binding = 0) readonly buffer lc_Input { int lc_input[]; };
#ifdef VULKAN
layout(push_constant) uniform lc_Parameters {
  int lc_V, lc_F, lc_C, lc_E, lc_depth, lc_level, lc_items, lc_places, lc_vertices, lc_triangles;
};
#else
uniform int lc_V, lc_F, lc_C, lc_E, lc_depth, lc_level, lc_items, lc_places, lc_vertices, lc_triangles, lc_first_patch;
#endif
float lc_number(int k) { return intBitsToFloat(lc_input[k]); }
vec3 lc_position(int v) { return vec3(lc_number(3 * v), lc_number(3 * v + 1), lc_number(3 * v + 2)); }
int lc_vertex(int h) { return lc_input[3 * lc_V + h]; }
int lc_twin(int h) { return lc_input[3 * lc_V + lc_C + h]; }
int lc_edge(int h) { return lc_input[3 * lc_V + 2 * lc_C + h]; }
int lc_face(int h) { return lc_input[3 * lc_V + 3 * lc_C + h]; }
float lc_sharpness(int h) { return lc_number(3 * lc_V + 4 * lc_C + h); }
int lc_first(int f) { return lc_input[3 * lc_V + 5 * lc_C + f]; }
int lc_size(int f) { return lc_first(f + 1) - lc_first(f); }
float lc_vertex_sharpness(int v) { return lc_number(3 * lc_V + 5 * lc_C + lc_F + 1 + v); }
int lc_next(int h) { return h + 1 < lc_first(lc_face(h) + 1) ? h + 1 : lc_first(lc_face(h)); }
ivec4 lc_counts(int steps) {
  ivec4 n = ivec4(lc_V, lc_F, lc_C, lc_E);
  for (int k = 0; k < steps; ++k)
#ifdef LC_LOOP
    n = ivec4(n.x + n.w, 4 * n.y, 12 * n.y, 2 * n.w + 3 * n.y);
#else
    n = ivec4(n.x + n.w + n.y, n.z, 4 * n.z, 2 * n.w + n.z);
#endif
  return n;
}
int lc_prev(int h) { return h > lc_first(lc_face(h)) ? h - 1 : lc_first(lc_face(h) + 1) - 1; }
)";

constexpr const char* kCompute = R"(
layout(std430, binding = 1) buffer lc_Output { int lc_output[]; };
#define lc_item int(gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x)
void lc_put_vector(int k, vec3 x) {
  lc_output[4 + 3 * k] = floatBitsToInt(x.x);
  lc_output[5 + 3 * k] = floatBitsToInt(x.y);
  lc_output[6 + 3 * k] = floatBitsToInt(x.z);
}
void lc_put_vertex(int k, vec3 position, vec3 normal) {
  if (k < 0) atomicMin(lc_output[1], max(k, -2147483647) - 1);
  else if (k >= lc_vertices) atomicMax(lc_output[0], k);
  else { lc_put_vector(k, position); lc_put_vector(lc_vertices + k, normal); }
}
void lc_put_vertex(int k, vec3 position) { lc_put_vertex(k, position, vec3(0)); }
void lc_put_triangle(int k, int a, int b, int c) {
  if (k < 0) atomicMin(lc_output[3], max(k, -2147483647) - 1);
  else if (k >= lc_triangles) atomicMax(lc_output[2], k);
  else {
    int at = 4 + 6 * lc_vertices + 3 * k;
    lc_output[at] = a; lc_output[at + 1] = b; lc_output[at + 2] = c;
  }
}
)";

constexpr const char* kPlace = R"(
struct lc_place { int face, corner, i, j, denominator; vec2 uv; };
)";
constexpr const char* kEachPlace = R"(
void main() {
  int k = lc_item;
  if (k >= lc_items) return;
  int w = lc_places + 5 * k;
  lc_place at = lc_place(lc_input[w], lc_input[w + 1], lc_input[w + 2], lc_input[w + 3], lc_input[w + 4], vec2(0));
  at.uv = vec2(at.i, at.j) / float(at.denominator);
  vec3 position, normal;
  lc_evaluate(at, position, normal);
  lc_put_vertex(k, position, normal);
}
)";

constexpr const char* kPatch = R"(
int lc_patch_word(int k) { return lc_input[lc_places + 3 * (gl_PrimitiveID + lc_first_patch) + k]; }
#define lc_patch_face lc_patch_word(0)
#define lc_patch_corner lc_patch_word(1)
#define lc_patch_steps lc_patch_word(2)
)";
constexpr const char* kPut = R"(
#define LC_EVALUATION 1
out vec3 lc_out_position, lc_out_normal;
flat out ivec2 lc_out_place;
out vec2 lc_out_uv;
void lc_put(vec3 position, vec3 normal, int face, int corner, vec2 uv) {
  lc_out_position = position; lc_out_normal = normal; lc_out_place = ivec2(face, corner); lc_out_uv = uv;
}
)";
constexpr const char* kControl = R"(
layout(vertices = 1) out;
void main() {
  for (int k = 0; k < 4; ++k) gl_TessLevelOuter[k] = float(lc_patch_steps);
  for (int k = 0; k < 2; ++k) gl_TessLevelInner[k] = float(lc_patch_steps);
}
)";

}  // namespace

HalfEdges::HalfEdges(const lc_mesh& mesh) {
  const std::int64_t vertices = mesh.vertex_count, corners = mesh.corner_count;
  if (vertices > (1 << 24) || corners > (1 << 26))
    throw SubjectError(LC_NOT_SUPPORTED, "more vertices or corners than a shader is given");
  std::vector<std::int32_t> twin(static_cast<std::size_t>(corners), -1), edge(twin), face(twin), first;
  std::vector<float> sharp(twin.size()), sharp_vertex(static_cast<std::size_t>(vertices));
  std::vector<std::int32_t> faces_at(sharp_vertex.size());

  // The half-edges between two vertices, by the lower one: two, or one at the boundary.
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> half_edge_of;
  std::int32_t edges = 0, h = 0;
  for (std::int64_t f = 0; f < mesh.face_count; ++f) {
    first.push_back(h);
    const std::int32_t begin = h, size = mesh.face_sizes[f];
    for (; h < begin + size; ++h) {
      const auto at = static_cast<std::size_t>(h);
      const std::int32_t a = mesh.corners[h], b = mesh.corners[begin + (h - begin + 1) % size];
      face[at] = static_cast<std::int32_t>(f);
      ++faces_at[static_cast<std::size_t>(a)];
      const auto [other, is_new] = half_edge_of.try_emplace(std::minmax(a, b), h);
      if (is_new) {
        edge[at] = edges++;
        continue;
      }
      const auto partner = static_cast<std::size_t>(other->second);
      twin[at] = other->second, twin[partner] = h, edge[at] = edge[partner];
    }
  }
  first.push_back(h);
  for (std::size_t k = 0; k < sharp.size(); ++k)
    if (twin[k] < 0) sharp[k] = data::kInfiniteSharpness;
  for (const lc_sharp_edge& e : std::span(mesh.sharp_edges, static_cast<std::size_t>(mesh.sharp_edge_count)))
    if (const auto found = half_edge_of.find(std::minmax(e.a, e.b)); found != half_edge_of.end())
      if (const std::int32_t other = twin[static_cast<std::size_t>(found->second)]; other >= 0)
        sharp[static_cast<std::size_t>(found->second)] = sharp[static_cast<std::size_t>(other)] = e.sharpness;
  if (mesh.corners_held != 0)
    for (std::size_t k = 0; k < twin.size(); ++k)
      if (const auto v = static_cast<std::size_t>(mesh.corners[k]); twin[k] < 0 && faces_at[v] == 1)
        sharp_vertex[v] = data::kInfiniteSharpness;
  for (const lc_sharp_vertex& v :
       std::span(mesh.sharp_vertices, static_cast<std::size_t>(mesh.sharp_vertex_count)))
    sharp_vertex[static_cast<std::size_t>(v.vertex)] =
        std::max(sharp_vertex[static_cast<std::size_t>(v.vertex)], v.sharpness);

  counts = {vertices, mesh.face_count, corners, edges};
  const auto put = [&](float x) { words.push_back(std::bit_cast<std::int32_t>(x)); };
  for (std::int64_t k = 0; k < 3 * vertices; ++k) put(static_cast<float>(mesh.positions[k]));
  words.insert(words.end(), mesh.corners, mesh.corners + corners);
  for (const auto* list : {&twin, &edge, &face}) words.insert(words.end(), list->begin(), list->end());
  for (const float s : sharp) put(s);
  words.insert(words.end(), first.begin(), first.end());
  for (const float s : sharp_vertex) put(s);
}

namespace {

std::string before(lc_scheme scheme) {
  return fmt::format("#version 450 core\n#line {}\n#define {} 1\n{}", kNotOfTheFile,
                     scheme == LC_SCHEME_LOOP ? "LC_LOOP" : "LC_CATMULL_CLARK", kMesh);
}
std::string of_the_user(const ShaderSource& source) {
  return fmt::format("#line 1\n{}\n#line {}\n", source.text, kNotOfTheFile);
}
// defined: what there is more of before the user's text.
std::string compute_text(const ShaderSource& source, lc_scheme scheme, const std::string& defined = "") {
  const bool function = source.form == ShaderSource::Form::kFunction;
  return before(scheme) + (source.own_group ? "" : "layout(local_size_x = 64) in;\n") + kCompute +
         (function ? kPlace : "") + defined + of_the_user(source) + (function ? kEachPlace : "");
}

// Mesa's driver for the processor (22.3.6) computes wrong points where a group leaves lanes of its vectors empty; softpipe,
// its other one, does not, with the same shaders.
void refuse_groups_with_empty_lanes(const GlProgram& program, const std::string& file) {
  constexpr int kLanes = 8;
  const std::array<GLint, 3> group = program.group();
  const int size = group[0] * group[1] * group[2];
  if (size % kLanes != 0 &&
      std::string_view(reinterpret_cast<const char*>(glGetString(GL_RENDERER))).starts_with("llvmpipe"))
    throw SubjectError(
        LC_INVALID_INPUT,
        fmt::format("{}: work groups of {}: llvmpipe computes wrong points in groups that are no "
                    "multiple of {}; take 8, 16, 32 or 64 for local_size_x",
                    file, size, kLanes));
}

}  // namespace

GlPrograms::GlPrograms(const ShaderSource& source, lc_scheme scheme) {
  const CurrentGl gl;
  const auto add = [&](const std::vector<GlProgram::Stage>& stages,
                       const std::vector<const char*>& captured = {}) {
    programs_.push_back(std::make_unique<GlProgram>(stages, source.file, captured));
    if (captured.empty()) refuse_groups_with_empty_lanes(*programs_.back(), source.file);
  };
  try {
    switch (source.form) {
      case ShaderSource::Form::kFunction:
        add({{GL_COMPUTE_SHADER, compute_text(source, scheme)}});
        break;
      case ShaderSource::Form::kPasses:
        for (const ShaderSource::Pass& pass : source.passes)
          add({{GL_COMPUTE_SHADER, compute_text(source, scheme, "#define " + pass.name + " 1\n")}});
        break;
      case ShaderSource::Form::kTessellation:
        add({{GL_VERTEX_SHADER, "#version 450 core\nvoid main() {}\n"},
             {GL_TESS_CONTROL_SHADER,
              before(scheme) + kPatch +
                  (source.own_control ? "#define LC_CONTROL 1\n" + of_the_user(source) : kControl)},
             {GL_TESS_EVALUATION_SHADER, before(scheme) + kPatch + kPut + of_the_user(source)}},
            {"lc_out_position", "lc_out_normal", "lc_out_place", "lc_out_uv"});
        break;
    }
  } catch (const std::runtime_error& error) {
    programs_.clear();  // while there is a context
    throw SubjectError(LC_INVALID_INPUT, error.what());
  }
}

std::int64_t GlPrograms::most_bytes_of_a_buffer() const {
  const CurrentGl gl;
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  return most;
}

void GlPrograms::run(std::span<const ComputeStep> steps, std::vector<ComputeBuffer>& buffers) const {
  const CurrentGl gl;
  std::vector<GuardedBuffer> there;
  for (const ComputeBuffer& b : buffers) {
    there.emplace_back(b.size).write(b.content.data(), b.size);
    there.back().bind(b.binding);
  }
  for (const ComputeStep& step : steps) used(step.program, step.parameters).compute(step.items);
  for (std::size_t k = 0; k < buffers.size(); ++k) buffers[k].content = there[k].read();
}

const GlProgram& GlPrograms::used(std::size_t program, const Parameters& parameters) const {
  const GlProgram& its = *programs_[program];
  its.use();
  for (std::size_t k = 0; k < parameters.size(); ++k) its.set(kParameters.at(k), parameters.at(k));
  return its;
}

std::string vulkan_text(const ShaderSource& source) {
  if (source.form == ShaderSource::Form::kTessellation)
    throw SubjectError(LC_INVALID_INPUT, source.file + ": tessellation shaders are audited by OpenGL alone");
  return compute_text(source, source.one_scheme());
}

}  // namespace limitcheck::verify
