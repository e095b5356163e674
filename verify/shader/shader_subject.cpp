// SPDX-License-Identifier: MIT
#include "verify/shader/shader_subject.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <new>
#include <optional>
#include <utility>

#include "verify/gl/context.h"
#include "verify/peers/evaluated_faces.h"
#include "verify/shader/prelude.h"
#include "verify/subject/adapter.h"
#include "verify/subject/devices.h"
#include "verify/subject/written_outside.h"

namespace limitcheck::verify {

namespace {

using Form = ShaderSource::Form;
using Programs = std::vector<std::unique_ptr<GlProgram>>;

std::optional<ShaderSource> the_source;

// Once for each scheme, and there until the process ends.
const Programs& programs(lc_scheme scheme) {
  static auto& made = *new std::map<lc_scheme, Programs>;
  const auto found = made.find(scheme);
  return found != made.end() ? found->second
                             : made.emplace(scheme, compiled(*the_source, scheme)).first->second;
}

// Of so many vectors of three numbers.
std::size_t bytes_of(std::int64_t elements) {
  return 12 * static_cast<std::size_t>(elements);
}

class ShaderSubject {
 public:
  static lc_capabilities capabilities(Options&, lc_scheme scheme) {
    const ShaderSource& s = *the_source;
    // Whichever scheme is asked about: what does not compile is bad input.
    const lc_scheme its = s.schemes == LC_DOES_LOOP            ? LC_SCHEME_LOOP
                          : s.schemes == LC_DOES_CATMULL_CLARK ? LC_SCHEME_CATMULL_CLARK
                                                               : scheme;
    const CurrentGl gl;
    (void)programs(its);
    Devices::note(s.file, gl_device());
    lc_capabilities c{LC_FLOAT32, s.weights, s.boundary, s.points, s.max_depth, s.normals, 0, !s.approximate};
    c.schemes = s.schemes;
    c.sharp = s.sharp;
    c.does_not_validate = 1;
    c.no_provenance = s.form == Form::kPasses;
    c.points_anywhere = s.form == Form::kTessellation && s.points == LC_POINTS_LIMIT;
    return c;
  }

  ShaderSubject(const lc_mesh& mesh, Options&) : mesh_(mesh), half_edges_(mesh) {
    if (the_source->quads_only && std::any_of(mesh.face_sizes, mesh.face_sizes + mesh.face_count,
                                              [](std::int32_t n) { return n != 4; }))
      throw SubjectError(LC_NOT_SUPPORTED, the_source->file + " does quads alone, as it says");
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    const CurrentGl gl;
    counts_ = {mesh_.scheme, half_edges_.counts, uniform_depth(request, mesh_), 0};
    switch (the_source->form) {
      case Form::kFunction:
        return run_function(request, out);
      case Form::kPasses:
        return run_passes(request, out);
      case Form::kTessellation:
        return run_tessellation(request, out);
    }
  }

 private:
  // What all programs know.
  void begin(const GlProgram& program, std::int64_t items, std::int64_t vertices,
             std::int64_t triangles) const {
    program.use();
    const auto& [v, f, c, e] = half_edges_.counts;
    for (const auto& [name, value] : {std::pair{"lc_V", v},
                                      {"lc_F", f},
                                      {"lc_C", c},
                                      {"lc_E", e},
                                      {"lc_depth", counts_.depth},
                                      {"lc_level", counts_.level},
                                      {"lc_items", items},
                                      {"lc_vertices", vertices},
                                      {"lc_triangles", triangles},
                                      {"lc_places", static_cast<std::int64_t>(half_edges_.words.size())}})
      program.set(name, static_cast<std::int32_t>(value));
  }
  GuardedBuffer device_buffer(std::int64_t bytes) const {
    GLint64 most = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    if (bytes < 0 || bytes > most - static_cast<std::int64_t>(GuardedBuffer::kGuard))
      throw SubjectError(LC_NOT_SUPPORTED,
                         fmt::format("a buffer of {} bytes: {} are what {} has", bytes, most, gl_device()));
    return GuardedBuffer(static_cast<std::size_t>(bytes));
  }
  GuardedBuffer output_buffer(std::int64_t vertices, std::int64_t triangles) const {
    return device_buffer(4 * (static_cast<std::int64_t>(kOutputHead) + 6 * vertices + 3 * triangles));
  }

  // Hands over what lies in the output buffer.
  static void take(const GuardedBuffer& buffer, const Output<float>& output, std::int64_t vertices,
                   std::int64_t triangles, bool indices) {
    const std::vector<std::byte> content = buffer.read();
    std::array<std::int32_t, kOutputHead> beyond{};
    std::memcpy(beyond.data(), content.data(), sizeof beyond);
    const std::byte* from = content.data() + sizeof beyond;
    const std::size_t bytes = 12 * static_cast<std::size_t>(vertices);
    std::memcpy(output.positions, from, bytes);
    if (output.normals != nullptr) std::memcpy(output.normals, from + bytes, bytes);
    if (indices) std::memcpy(output.triangles, from + 2 * bytes, 12 * static_cast<std::size_t>(triangles));
    if (beyond[0] >= 0)
      show_written_behind(output.positions + 3 * vertices, bytes_of(std::int64_t{1} + beyond[0] - vertices));
    if (beyond[1] < -1) show_written_before(output.positions, bytes_of(std::int64_t{-1} - beyond[1]));
    if (beyond[2] >= 0)
      show_written_behind(output.triangles + 3 * triangles,
                          bytes_of(std::int64_t{1} + beyond[2] - triangles));
    if (beyond[3] < -1) show_written_before(output.triangles, bytes_of(std::int64_t{-1} - beyond[3]));
    if (content.size() > buffer.size())
      show_written_behind(output.triangles + 3 * triangles, content.size() - buffer.size());
  }

  void run_function(const lc_request& request, lc_tessellation& out) {
    const FacePatterns patterns(mesh_, request,
                                [](int depth) { return lattice_pattern(data::Scheme::kLoop, 3, depth); });
    const auto output =
        allocate_output<float>(request, out, patterns.vertices(), patterns.triangles(), the_source->normals,
                               /*corners=*/mesh_.scheme == LC_SCHEME_CATMULL_CLARK);
    std::vector<std::int32_t> words = half_edges_.words;
    for (std::int64_t f = 0; f < patterns.faces(); ++f) {
      write_pattern(patterns, f, output);
      if (const FacePattern* const pattern = patterns.of(f).pattern; pattern != nullptr)
        for (const FaceDomain::Point& p : pattern->points)
          words.insert(words.end(),
                       {static_cast<std::int32_t>(f), p.part, static_cast<std::int32_t>(p.i),
                        static_cast<std::int32_t>(p.j), static_cast<std::int32_t>(pattern->denominator)});
    }
    const GuardedBuffer input(words);
    const GuardedBuffer buffer = output_buffer(patterns.vertices(), 0);
    input.bind(0), buffer.bind(1);
    const GlProgram& program = *programs(mesh_.scheme).front();
    begin(program, patterns.vertices(), patterns.vertices(), 0);
    program.compute(patterns.vertices());
    take(buffer, output, patterns.vertices(), patterns.triangles(), /*indices=*/false);
  }

  void run_passes(const lc_request& request, lc_tessellation& out) {
    const std::int64_t vertices = number(the_source->output[0]), triangles = number(the_source->output[1]);
    const auto output = allocate_output<float>(request, out, vertices, triangles, the_source->normals);
    out.provenance = nullptr, out.triangle_face = nullptr;
    const GuardedBuffer input(half_edges_.words);
    const GuardedBuffer buffer = output_buffer(vertices, triangles);
    input.bind(0), buffer.bind(1);
    std::vector<GuardedBuffer> own;
    for (const ShaderSource::Buffer& b : the_source->buffers) {
      own.push_back(device_buffer(number(b.bytes)));
      own.back().bind(static_cast<GLuint>(b.binding));
    }
    const auto& passes = the_source->passes;
    const auto run = [&](std::size_t k) {
      const std::int64_t items = number(passes[k].items);
      const GlProgram& program = *programs(mesh_.scheme)[k];
      begin(program, items, vertices, triangles);
      program.compute(items);
    };
    for (std::size_t k = 0, end = 0; k < passes.size(); k = end) {
      end = k + 1;
      counts_.level = 0;
      if (passes[k].levels.empty()) {
        run(k);
        continue;
      }
      const auto text = [&](std::size_t p, std::size_t which) { return passes[p].levels[which].text(); };
      while (end < passes.size() && !passes[end].levels.empty() && text(end, 0) == text(k, 0) &&
             text(end, 1) == text(k, 1))
        ++end;
      const std::int64_t first = passes[k].levels[0].value(counts_),
                         last = passes[k].levels[1].value(counts_);
      for (counts_.level = first; counts_.level <= last; ++counts_.level)
        for (std::size_t p = k; p < end; ++p) run(p);
    }
    take(buffer, output, vertices, triangles, /*indices=*/true);
    for (const GuardedBuffer& b : own)
      if (const std::size_t all = b.read().size(); all > b.size()) {
        auto* const shown = static_cast<std::byte*>(request.allocate(request.host, b.size()));
        if (shown == nullptr) throw std::bad_alloc();
        show_written_behind(shown + b.size(), all - b.size());
      }
  }
  std::int64_t number(const Formula& formula) const {
    const std::int64_t value = formula.value(counts_);
    if (value < 0 || value > INT32_MAX)
      throw SubjectError(
          LC_NOT_SUPPORTED,
          fmt::format("{} is {} here: numbers of a shader are from 0 to 2^31 - 1", formula.text(), value));
    return value;
  }

  void run_tessellation(const lc_request& request, lc_tessellation& out) {
    const bool loop = mesh_.scheme == LC_SCHEME_LOOP;
    std::vector<std::int32_t> words = half_edges_.words;
    for (std::int64_t f = 0; f < mesh_.face_count; ++f) {
      const std::int32_t size = mesh_.face_sizes[f];
      const bool cut = !loop && size != 4;
      if (cut && counts_.depth == 0)
        throw SubjectError(LC_NOT_SUPPORTED, "depth 0 of a face that is cut into quads has no patches");
      for (std::int32_t corner = 0; corner < (cut ? size : 1); ++corner)
        words.insert(words.end(),
                     {static_cast<std::int32_t>(f), corner, (1 << counts_.depth) >> (cut ? 1 : 0)});
    }
    const GuardedBuffer input(words);
    input.bind(0);
    const GlProgram& program = *programs(mesh_.scheme).front();
    begin(program, 0, 0, 0);
    const auto patches = static_cast<std::int64_t>((words.size() - half_edges_.words.size()) / kPatchWords);
    const std::vector<std::int32_t> put = captured_patches(program, {.count = patches}, kPutWords);
    const auto vertices = static_cast<std::int64_t>(put.size() / kPutWords);
    const auto output =
        allocate_output<float>(request, out, vertices, vertices / 3, the_source->normals, /*corners=*/!loop);
    for (std::int64_t k = 0; k < vertices; ++k) {
      const std::int32_t* const v = put.data() + static_cast<std::size_t>(k) * kPutWords;
      std::memcpy(output.positions + 3 * k, v, 12);
      if (output.normals != nullptr) std::memcpy(output.normals + 3 * k, v + 3, 12);
      const std::int32_t face = v[6], corner = v[7];
      output.provenance[k] = nearest_place(face, std::bit_cast<float>(v[8]), std::bit_cast<float>(v[9]));
      if (output.corner != nullptr) output.corner[k] = corner;
      output.triangles[k] = static_cast<std::uint32_t>(k);
      if (k % 3 == 0) output.triangle_face[k / 3] = face;
    }
  }

  const lc_mesh& mesh_;
  const HalfEdges half_edges_;
  MeshCounts counts_;
};

}  // namespace

const lc_subject& shader_subject(const std::string& file) {
  the_source = read_shader(file);
  static const lc_subject subject = make_subject<ShaderSubject>("shader", "a shader of OpenGL");
  return subject;
}

}  // namespace limitcheck::verify
