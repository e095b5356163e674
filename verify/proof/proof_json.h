// SPDX-License-Identifier: MIT
// Results of proofs as JSON that loses nothing, to go on with and to merge. (What programs read: ProofReport.)
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "verify/proof/certified_comparison.h"
#include "verify/proof/topologies/proof_row.h"

namespace limitcheck::verify {

nlohmann::json proof_rows_json(const std::vector<ProofRow>& rows);
std::vector<ProofRow> proof_rows_of(const nlohmann::json& json);

nlohmann::json certified_json(const std::vector<CertifiedLine>& lines);
std::vector<CertifiedLine> certified_of(const nlohmann::json& json);

}  // namespace limitcheck::verify
