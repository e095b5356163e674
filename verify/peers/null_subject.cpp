// SPDX-License-Identifier: MIT
// Delivers nothing and says so: zero vertices, zero triangles. Every check of an audit must fail on it, none
// may crash, and none may report an empty delivery as correct.
#include "verify/subject/adapter.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck::verify;

class NullSubject {
 public:
  static lc_capabilities capabilities(Options&) {
    return {LC_FLOAT64, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 10, 1, 1, 1};
  }
  NullSubject(const lc_mesh&, Options&) {}
  void tessellate(const lc_request& request, lc_tessellation& out) {
    allocate_output<double>(request, out, 0, 0, true);
  }
};

}  // namespace

extern "C" const lc_subject* lc_subject_null() {
  static const lc_subject subject =
      make_subject<NullSubject>("null", "delivers nothing: what every check must fail on");
  return &subject;
}
