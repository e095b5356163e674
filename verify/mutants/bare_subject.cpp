// SPDX-License-Identifier: MIT
// Another subject without its provenance: uniform depths, points and triangles alone, as most tessellators deliver.
#include <string>

#include "verify/subject/adapter.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

class BareSubject {
 public:
  static constexpr bool kLeavesRefusals = true;  // to the other subject

  static lc_capabilities capabilities(Options& options, lc_scheme scheme) {
    const lc_subject& of = inner(options);
    lc_capabilities result{};
    result.size = sizeof result;
    result.scheme = scheme;
    pass_on([&](const char** why) { return of.capabilities(options.rest().c_str(), &result, why); });
    result.per_face_depth = 0;
    result.no_provenance = 1;
    result.points_anywhere = 0;
    return result;
  }

  BareSubject(const lc_mesh& mesh, Options& options) : subject_(inner(options)) {
    pass_on(
        [&](const char** why) { return subject_.create(&mesh, options.rest().c_str(), &instance_, why); });
  }
  ~BareSubject() { subject_.destroy(instance_); }
  BareSubject(const BareSubject&) = delete;
  BareSubject& operator=(const BareSubject&) = delete;

  void tessellate(const lc_request& request, lc_tessellation& out) {
    pass_on([&](const char** why) { return subject_.tessellate(instance_, &request, &out, why); });
    out.provenance = nullptr;
    out.triangle_face = nullptr;
    out.corner = nullptr;
    subject_.release(instance_, &out);  // the arrays are the host's
  }

 private:
  // Of the options "bare=NAME,REST", where the rest is for that subject.
  static const lc_subject& inner(Options& options) {
    const lc_subject* const found = find_subject(options.value("bare", ""));
    if (found == nullptr) throw SubjectError(LC_INVALID_INPUT, "the options are bare=SUBJECT and its own");
    return *found;
  }
  template <class Call>
  static void pass_on(Call call) {
    const char* why = nullptr;
    if (const lc_status status = call(&why); status != LC_OK)
      throw SubjectError(status, why != nullptr ? why : "");
  }

  const lc_subject& subject_;
  void* instance_ = nullptr;
};

}  // namespace
}  // namespace limitcheck::verify

extern "C" const lc_subject* lc_subject_bare() {
  using namespace limitcheck::verify;
  static const lc_subject subject = make_subject<BareSubject>(
      "bare", "another subject without its provenance", "bare=SUBJECT, and the options of that subject");
  return &subject;
}
