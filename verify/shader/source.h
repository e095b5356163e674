// SPDX-License-Identifier: MIT
// A file of the shader door (verify/subject/SHADERS.md): its text, and what its pragmas say.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// What a number in a pragma may be made of.
struct MeshCounts {
  lc_scheme scheme = LC_SCHEME_LOOP;
  std::array<std::int64_t, 4> of{};  // vertices, faces, corners, edges of the control mesh
  std::int64_t depth = 0, level = 0;
  /// The same after so many steps of subdivision.
  std::array<std::int64_t, 4> after(std::int64_t steps) const;
};

/// A number in a pragma: "12*C*4^(d+1)", "V(level)+1". Numbers, V F C E (of the control mesh; with a number in brackets, after so
/// many steps), d, level, + - * / ^ and brackets, without blanks.
class Formula {
 public:
  explicit Formula(std::string text) : text_(std::move(text)) {}
  /// Throws SubjectError(LC_INVALID_INPUT): it is none, or its size is above 2^40.
  std::int64_t value(const MeshCounts& counts) const;
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

struct ShaderSource {
  enum class Form { kFunction, kPasses, kTessellation };
  struct Buffer {
    std::int32_t binding;
    Formula bytes;
  };
  struct Pass {
    std::string name;  // what is defined while it is compiled
    Formula items;
    std::vector<Formula> levels;  // the first and the last; none: it runs once
  };

  std::string file, text;  // without its #version
  bool spirv = false;      // a module; text is that of its pragmas
  Form form = Form::kFunction;
  std::int32_t schemes = LC_DOES_LOOP | LC_DOES_CATMULL_CLARK;
  std::int32_t sharp = 0;  // LC_SHARP_...
  lc_weights weights = LC_WEIGHTS_LOOP;
  lc_boundary boundary = LC_BOUNDARY_SPLINE;
  lc_points points = LC_POINTS_LIMIT;
  bool normals = true, approximate = false, quads_only = false, own_control = false, own_group = false;
  std::int32_t max_depth = 10;
  std::vector<Buffer> buffers;
  std::vector<Pass> passes;
  std::vector<Formula> output;  // vertices, triangles

  /// Throws SubjectError(LC_INVALID_INPUT) if it does both.
  lc_scheme one_scheme() const;
};

/// A file of GLSL; or what the pragmas in FILE.spv.pragmas say of a module FILE.spv.
/// Throws SubjectError(LC_INVALID_INPUT), with the file and its line: it cannot be read, or a pragma means nothing.
ShaderSource read_shader(const std::string& file);

}  // namespace limitcheck::verify
