// SPDX-License-Identifier: MIT
#include "verify/audit/digits.h"

#include "reference/certified.h"

namespace limitcheck::verify {

void add_digits(Result& result, const data::ControlMesh& mesh) {
  if (!is_bad(result) || !result.witness || result.witness->l1.empty()) return;
  if (result.check != "positions" && result.check != "normals") return;
  Witness& w = *result.witness;
  try {
    const auto point = reference::CertifiedEvaluator(mesh, result.weights)
                           .evaluate(static_cast<int>(w.face), reference::Parameter::parse(w.l1),
                                     reference::Parameter::parse(w.l2), 40);
    for (const auto& coordinate : result.check == "positions" ? point.position : point.normal)
      w.expected_digits.push_back(coordinate.value);
  } catch (const std::exception&) {  // the witness in double stays
  }
}

}  // namespace limitcheck::verify
