// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace limitcheck::bench {

/// An OpenGL 3.3 core context without window or display (EGL, surfaceless), current on the thread that made
/// it. Debian's Mesa draws with the processor (llvmpipe) where there is no graphics card. Throws
/// std::runtime_error and says at which step it failed.
class GlContext {
 public:
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Renderer and version, which every frame rate is reported with.
  std::string renderer() const;

 private:
  void* display_;
  void* context_;
};

}  // namespace limitcheck::bench
