// SPDX-License-Identifier: MIT
#include "verify/gl/context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <unistd.h>
// EGL names the extension only where the platform's headers are new enough
#ifndef EGL_PLATFORM_SURFACELESS_MESA
#define EGL_PLATFORM_SURFACELESS_MESA 0x31DD
#endif

#include <fmt/core.h>

#include <array>
#include <stdexcept>

namespace limitcheck::verify {

namespace {

[[noreturn]] void fail(const char* step) {
  throw std::runtime_error(
      fmt::format("no OpenGL without a display: {} failed (EGL error {:#x}); Debian: libegl1 libgl1-mesa-dri",
                  step, static_cast<unsigned>(eglGetError())));
}

// A graphics card that needs no display, if EGL names one: Mesa's surfaceless platform is the software's otherwise.
EGLDisplay card() {
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") ||
      !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device"))
    return EGL_NO_DISPLAY;
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count)) return EGL_NO_DISPLAY;
  for (EGLint k = 0; k < count; ++k) {
    const EGLDeviceEXT device = devices[static_cast<std::size_t>(k)];
    if (epoxy_extension_in_string(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS),
                                  "EGL_MESA_device_software"))
      continue;
    const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
  }
  return EGL_NO_DISPLAY;
}

// With an array of vertices and a framebuffer, both empty: without them nothing is drawn, and nothing captured.
struct Shared {
  GlContext context{4, 5};
  pid_t process = getpid();
  std::string device = context.renderer();
  Shared() {
    GLuint array = 0, frame = 0;
    glGenVertexArrays(1, &array);
    glBindVertexArray(array);
    glGenFramebuffers(1, &frame);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_WIDTH, 1);
    glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_HEIGHT, 1);
  }
};
// Never destroyed: what a driver has at the end of a process is not there any more when objects of static storage go.
Shared* shared = nullptr;
std::mutex one_at_a_time;

}  // namespace

GlContext::GlContext(int major, int minor) {
  if (!lack_of_gl().empty()) throw std::runtime_error(lack_of_gl());
  EGLDisplay display = card();
  if (display == EGL_NO_DISPLAY) {
    // Where libEGL finds no driver it has none of these, and epoxy ends the process of who calls it.
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) fail("EGL_EXT_platform_base");
    display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY) fail("eglGetPlatformDisplay");
    if (!eglInitialize(display, nullptr, nullptr)) fail("eglInitialize");
  }
  if (!eglBindAPI(EGL_OPENGL_API)) fail("eglBindAPI");
  const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
  EGLConfig config;
  EGLint count = 0;
  if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) fail("eglChooseConfig");
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                            major,
                            EGL_CONTEXT_MINOR_VERSION,
                            minor,
                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                            EGL_NONE};
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
  if (context == EGL_NO_CONTEXT) fail(fmt::format("eglCreateContext {}.{}", major, minor).c_str());
  display_ = display;
  context_ = context;
  make_current();
}

GlContext::~GlContext() {
  release();
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

void GlContext::make_current() const {
  if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) fail("eglMakeCurrent");
}

void GlContext::release() const {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

std::string GlContext::renderer() const {
  return fmt::format("{}, OpenGL {}", reinterpret_cast<const char*>(glGetString(GL_RENDERER)),
                     reinterpret_cast<const char*>(glGetString(GL_VERSION)));
}

const std::string& lack_of_gl() {
  // Both are small and load no driver. libGL is where OpenSubdiv looks for OpenGL's functions.
  static const std::string lack = [] {
    for (const char* library : {"libEGL.so.1", "libGL.so.1"})
      if (dlopen(library, RTLD_LAZY | RTLD_LOCAL) == nullptr)
        return fmt::format("no OpenGL: {} is not there (Debian packages libegl1, libgl1 and libgl1-mesa-dri)",
                           library);
    return std::string();
  }();
  return lack;
}

CurrentGl::CurrentGl() : lock_(one_at_a_time) {
  if (shared == nullptr) {
    shared = new Shared;
    return;
  }
  if (shared->process != getpid())  // whose driver has threads that are not here
    throw std::runtime_error("no OpenGL: it belongs to the process that this one was forked from");
  shared->context.make_current();
}

CurrentGl::~CurrentGl() {
  shared->context.release();
}

const std::string& gl_device() {
  static const std::string none;
  return shared != nullptr ? shared->device : none;
}

}  // namespace limitcheck::verify
