// SPDX-License-Identifier: MIT
// OpenGL without a window or display.
#pragma once

#include <mutex>
#include <string>

namespace limitcheck::verify {

/// An OpenGL core context (EGL; of a graphics card where its driver has one, else surfaceless), current on the thread
/// that made it. Debian's Mesa computes with the processor (llvmpipe) where there is no graphics card.
class GlContext {
 public:
  /// Of this version or a later one. Throws std::runtime_error and says at which step it failed.
  explicit GlContext(int major = 3, int minor = 3);
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Device and driver: "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa 22.3.6".
  std::string renderer() const;
  void make_current() const;
  void release() const;

 private:
  void* display_;
  void* context_;
};

/// Why OpenGL cannot even be tried, in words: a library is not there. Empty: it can.
const std::string& lack_of_gl();

/// OpenGL 4.5 for subjects that compute on a GPU, current on the caller's thread while an object of this class lives;
/// other threads wait. An empty array of vertices and a framebuffer without attachments are bound. It is made when first
/// asked for, and stays until the process ends.
class CurrentGl {
 public:
  /// Throws std::runtime_error if there is none to be had: in a process forked from one that has it, too.
  CurrentGl();
  ~CurrentGl();
  CurrentGl(const CurrentGl&) = delete;
  CurrentGl& operator=(const CurrentGl&) = delete;

 private:
  std::lock_guard<std::mutex> lock_;
};

/// GlContext::renderer() of that context; empty while nobody has asked for it in this process.
const std::string& gl_device();

}  // namespace limitcheck::verify
