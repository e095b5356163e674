// SPDX-License-Identifier: MIT
#include "verify/shader/shader_subject.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <span>

#include "verify/gl/context.h"
#include "verify/gl/guard_zone.h"
#include "verify/peers/evaluated_faces.h"
#include "verify/shader/prelude.h"
#include "verify/subject/adapter.h"
#include "verify/subject/devices.h"
#include "verify/subject/written_outside.h"

namespace limitcheck::verify {

namespace {

using Form = ShaderSource::Form;

std::optional<ShaderSource> the_source;

// Once for each scheme, and there until the process ends.
const ComputePrograms& programs(lc_scheme scheme) {
  static auto& made = *new std::map<lc_scheme, std::unique_ptr<ComputePrograms>>;
  auto found = made.find(scheme);
  if (found == made.end())
    found = made.emplace(scheme, the_source->spirv ? spirv_programs(*the_source)
                                                   : std::make_unique<GlPrograms>(*the_source, scheme))
                .first;
  return *found->second;
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
    Devices::note(s.file, programs(its).device());
    lc_capabilities c{LC_FLOAT32, s.weights, s.boundary, s.points, s.max_depth, s.normals, 0, !s.approximate};
    c.schemes = s.schemes;
    c.sharp = s.sharp;
    c.does_not_validate = 1;
    c.quads_only = s.quads_only;
    c.no_provenance = s.form == Form::kPasses;
    c.points_anywhere = s.form == Form::kTessellation && s.points == LC_POINTS_LIMIT;
    return c;
  }

  ShaderSubject(const lc_mesh& mesh, Options&) : mesh_(mesh), half_edges_(mesh) {}

  void tessellate(const lc_request& request, lc_tessellation& out) {
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
  // What all programs know, in the order of kParameters.
  Parameters known(std::int64_t items, std::int64_t vertices, std::int64_t triangles) const {
    const auto& [v, f, c, e] = half_edges_.counts;
    const std::array all{v,
                         f,
                         c,
                         e,
                         counts_.depth,
                         counts_.level,
                         items,
                         static_cast<std::int64_t>(half_edges_.words.size()),
                         vertices,
                         triangles};
    Parameters numbers;
    std::transform(all.begin(), all.end(), numbers.begin(),
                   [](std::int64_t n) { return static_cast<std::int32_t>(n); });
    return numbers;
  }
  static ComputeBuffer input(const std::vector<std::int32_t>& words) {
    const auto bytes = std::as_bytes(std::span(words));
    return {0, {bytes.begin(), bytes.end()}};
  }
  ComputeBuffer device_buffer(std::int32_t binding, std::int64_t bytes) const {
    const ComputePrograms& its = programs(mesh_.scheme);
    const std::int64_t most = its.most_bytes_of_a_buffer();
    if (bytes < 0 || bytes > most - static_cast<std::int64_t>(kDeviceGuard))
      throw SubjectError(LC_NOT_SUPPORTED,
                         fmt::format("a buffer of {} bytes: {} are what {} has", bytes, most, its.device()));
    return {static_cast<std::uint32_t>(binding),
            std::vector<std::byte>(static_cast<std::size_t>(bytes), std::byte{0xFF})};
  }
  ComputeBuffer output_buffer(std::int64_t vertices, std::int64_t triangles) const {
    return device_buffer(1, 4 * (static_cast<std::int64_t>(kOutputHead) + 6 * vertices + 3 * triangles));
  }

  // Hands over what lies in the output buffer.
  static void take(const ComputeBuffer& buffer, const Output<float>& output, std::int64_t vertices,
                   std::int64_t triangles, bool indices) {
    const std::vector<std::byte>& content = buffer.content;
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
    if (content.size() > buffer.size)
      show_written_behind(output.triangles + 3 * triangles, content.size() - buffer.size);
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
    const std::int64_t items = patterns.vertices();
    std::vector<ComputeBuffer> buffers{input(words), output_buffer(items, 0)};
    programs(mesh_.scheme).run(std::array{ComputeStep{0, items, known(items, items, 0)}}, buffers);
    take(buffers[1], output, patterns.vertices(), patterns.triangles(), /*indices=*/false);
  }

  void run_passes(const lc_request& request, lc_tessellation& out) {
    const std::int64_t vertices = number(the_source->output[0]), triangles = number(the_source->output[1]);
    const auto output = allocate_output<float>(request, out, vertices, triangles, the_source->normals);
    out.provenance = nullptr, out.triangle_face = nullptr;
    std::vector<ComputeBuffer> buffers{input(half_edges_.words), output_buffer(vertices, triangles)};
    for (const ShaderSource::Buffer& b : the_source->buffers)
      buffers.push_back(device_buffer(b.binding, number(b.bytes)));
    std::vector<ComputeStep> steps;
    const auto& passes = the_source->passes;
    const auto run = [&](std::size_t k) {
      const std::int64_t items = number(passes[k].items);
      steps.push_back({k, items, known(items, vertices, triangles)});
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
    programs(mesh_.scheme).run(steps, buffers);
    take(buffers[1], output, vertices, triangles, /*indices=*/true);
    for (std::size_t k = 2; k < buffers.size(); ++k)
      if (const ComputeBuffer& b = buffers[k]; b.content.size() > b.size) {
        auto* const shown = static_cast<std::byte*>(request.allocate(request.host, b.size));
        if (shown == nullptr) throw std::bad_alloc();
        show_written_behind(shown + b.size, b.content.size() - b.size);
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
    const CurrentGl gl;
    const GuardedBuffer given(words);
    given.bind(0);
    const GlProgram& program =
        dynamic_cast<const GlPrograms&>(programs(mesh_.scheme)).used(0, known(0, 0, 0));
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
  static const lc_subject subject = make_subject<ShaderSubject>("shader", "a shader of OpenGL or Vulkan");
  return subject;
}

}  // namespace limitcheck::verify
