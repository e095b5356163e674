// SPDX-License-Identifier: MIT
// Another subject without its provenance: uniform depths, points and triangles alone, as most tessellators deliver.
#include <fmt/core.h>

#include <cstring>
#include <memory>
#include <string>

#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

// "bare=NAME,REST": the subject, and what is left for it.
struct Inner {
  const lc_subject* subject = nullptr;
  const char* rest = nullptr;
};

Inner inner(const char* options) {
  constexpr std::size_t kKey = 5;
  if (options == nullptr || std::strncmp(options, "bare=", kKey) != 0) return {};
  const char* begin = options + kKey;
  const char* end = begin + std::strcspn(begin, ",");
  return {find_subject(std::string(begin, end)), *end == ',' ? end + 1 : nullptr};
}

struct Instance {
  const lc_subject* subject;
  void* of;
};

lc_status refuse(const char** message) {
  *message = "the options begin with bare=SUBJECT";
  return LC_INVALID_INPUT;
}

lc_status capabilities(const char* options, lc_capabilities* out, const char** message) {
  const auto [subject, rest] = inner(options);
  if (subject == nullptr) return refuse(message);
  const lc_status status = subject->capabilities(rest, out, message);
  out->per_face_depth = 0;
  out->no_provenance = 1;
  return status;
}

lc_status create(const lc_mesh* mesh, const char* options, void** instance, const char** message) {
  const auto [subject, rest] = inner(options);
  if (subject == nullptr) return refuse(message);
  auto made = std::make_unique<Instance>(Instance{subject, nullptr});
  const lc_status status = subject->create(mesh, rest, &made->of, message);
  if (status == LC_OK) *instance = made.release();
  return status;
}

lc_status tessellate(void* instance, const lc_request* request, lc_tessellation* out, const char** message) {
  const auto& i = *static_cast<Instance*>(instance);
  const lc_status status = i.subject->tessellate(i.of, request, out, message);
  out->provenance = nullptr;
  out->triangle_face = nullptr;
  out->corner = nullptr;
  return status;
}

void release(void* instance, lc_tessellation* out) {
  const auto& i = *static_cast<Instance*>(instance);
  i.subject->release(i.of, out);
}

void destroy(void* instance) {
  const std::unique_ptr<Instance> i(static_cast<Instance*>(instance));
  i->subject->destroy(i->of);
}

}  // namespace
}  // namespace limitcheck::verify

extern "C" const lc_subject* lc_subject_bare() {
  using namespace limitcheck::verify;
  static const lc_subject subject{LC_SUBJECT_ABI,
                                  "bare",
                                  "another subject without its provenance",
                                  "bare=SUBJECT first, and the options of that subject",
                                  capabilities,
                                  create,
                                  tessellate,
                                  release,
                                  destroy};
  return &subject;
}
