// SPDX-License-Identifier: MIT
// Another subject without its provenance: uniform depths, points and triangles alone, as most tessellators deliver.
#include <memory>
#include <string_view>

#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

// Of the options "bare=NAME,REST": the subject, and what is left for it.
struct Inner {
  explicit Inner(const char* options) {
    constexpr std::string_view kKey = "bare=";
    const std::string_view all = options != nullptr ? options : "";
    if (!all.starts_with(kKey)) return;
    const std::size_t end = all.find(',');
    subject = find_subject(all.substr(0, end).substr(kKey.size()));
    if (end != std::string_view::npos) rest = options + end + 1;
  }
  const lc_subject* subject = nullptr;
  const char* rest = nullptr;
};

struct Instance {
  const lc_subject* subject;
  void* of;
};

lc_status refuse(const char** message) {
  *message = "the options begin with bare=SUBJECT";
  return LC_INVALID_INPUT;
}

const lc_subject kBare{
    LC_SUBJECT_ABI,
    "bare",
    "another subject without its provenance",
    "bare=SUBJECT first, and the options of that subject",
    [](const char* options, lc_capabilities* out, const char** message) {
      const Inner inner(options);
      if (inner.subject == nullptr) return refuse(message);
      const lc_status status = inner.subject->capabilities(inner.rest, out, message);
      out->per_face_depth = 0;
      out->no_provenance = 1;
      out->points_anywhere = 0;
      return status;
    },
    [](const lc_mesh* mesh, const char* options, void** instance, const char** message) {
      const Inner inner(options);
      if (inner.subject == nullptr) return refuse(message);
      auto made = std::make_unique<Instance>(Instance{inner.subject, nullptr});
      const lc_status status = inner.subject->create(mesh, inner.rest, &made->of, message);
      if (status == LC_OK) *instance = made.release();
      return status;
    },
    [](void* instance, const lc_request* request, lc_tessellation* out, const char** message) {
      const auto [subject, of] = *static_cast<Instance*>(instance);
      const lc_status status = subject->tessellate(of, request, out, message);
      out->provenance = nullptr;
      out->triangle_face = nullptr;
      out->corner = nullptr;
      return status;
    },
    [](void* instance, lc_tessellation* out) {
      const auto [subject, of] = *static_cast<Instance*>(instance);
      subject->release(of, out);
    },
    [](void* instance) {
      const std::unique_ptr<Instance> own(static_cast<Instance*>(instance));
      own->subject->destroy(own->of);
    }};

}  // namespace
}  // namespace limitcheck::verify

extern "C" const lc_subject* lc_subject_bare() {
  return &limitcheck::verify::kBare;
}
