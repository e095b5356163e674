// SPDX-License-Identifier: MIT
// The subject `vtk` as the program knows it: hands every call to the shared library that holds VTK, which is
// loaded by the first of them.
#include <dlfcn.h>
#include <fmt/core.h>

#include <filesystem>
#include <string>

#include "verify/subject/registry.h"

#ifdef LIMITCHECK_VTK_MODULE

namespace {

namespace fs = std::filesystem;

struct Module {
  const lc_subject* subject = nullptr;
  std::string why_not;
};

// Where it was built, where it was installed, and where it is if all that was installed has been moved.
Module load() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  Module module;
  for (const fs::path& file : {fs::path(LIMITCHECK_VTK_MODULE), fs::path(LIMITCHECK_VTK_INSTALLED),
                               program.parent_path() / "lib/limitcheck/limitcheck-vtk.so"}) {
    if (!fs::exists(file, ignored)) continue;
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      module.why_not = fmt::format("cannot be loaded: {}", dlerror());
      continue;
    }
    const auto entry = reinterpret_cast<decltype(&lc_subject_get)>(dlsym(library, LC_SUBJECT_ENTRY));
    if (entry != nullptr && (module.subject = entry(LC_SUBJECT_ABI)) != nullptr) return module;
    module.why_not = fmt::format("{} is no subject for this program", file.string());
  }
  if (module.why_not.empty()) module.why_not = fmt::format("there is no {}", LIMITCHECK_VTK_INSTALLED);
  return module;
}

const Module& module() {
  static const Module loaded = load();
  return loaded;
}

lc_status absent(const char** message) {
  *message = module().why_not.c_str();
  return LC_FAILED;
}

}  // namespace

extern "C" const lc_subject* lc_subject_vtk() {
  static const lc_subject subject{
      LC_SUBJECT_ABI, "vtk",
      "VTK 9 vtkLoopSubdivisionFilter: refined vertices in float, no limit points, no normals", nullptr,
      [](const char* options, lc_capabilities* out, const char** message) {
        const lc_subject* vtk = module().subject;
        return vtk ? vtk->capabilities(options, out, message) : absent(message);
      },
      [](const lc_mesh* mesh, const char* options, void** instance, const char** message) {
        const lc_subject* vtk = module().subject;
        return vtk ? vtk->create(mesh, options, instance, message) : absent(message);
      },
      // An instance exists only if the library was loaded.
      [](void* instance, const lc_request* request, lc_tessellation* out, const char** message) {
        return module().subject->tessellate(instance, request, out, message);
      },
      [](void* instance, lc_tessellation* out) { module().subject->release(instance, out); },
      [](void* instance) { module().subject->destroy(instance); }};
  return &subject;
}

#else

extern "C" const lc_subject* lc_subject_vtk() {
  return nullptr;
}

#endif
