// SPDX-License-Identifier: MIT
// The report of an audit as JSON, and its rows as JSON that loses nothing.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "verify/causes/causes.h"

namespace limitcheck::verify {

/// The report as one JSON document. Keys of the header: program, version, depth, seconds, held, receipts (what
/// subjects in processes of their own took), never_judged, subjects, meshes (name with the generator's seed,
/// vertices, faces). `results`: subject, mesh, depth,
/// depths, sample, check, status, count (how many are wrong), of (of how many), worst, bound, unit, rms, p99,
/// worst_absolute, worst_ulps, message, witness (face, l1, l2 as fractions, vertex, triangle, expected, got,
/// expected_digits, command, reproduce) - null where it does not apply. The schema:
/// verify/report/schema/audit.schema.json.
///   level     of the audit, for the commands that repeat it
///   all_rows  false: of a report of more than kMostInFull rows `results` has the kInFull of each subject and check
///             that say most, and `in_short` the others: of findings case, status, count, of and worst, of the rest
///             how many there are
std::string to_json(const Report& report, const std::string& level = "standard", bool all_rows = false);
inline constexpr std::size_t kMostInFull = 2000, kInFull = 4;
/// Whether each row is one of those.
std::vector<bool> rows_in_full(const Report& report);
nlohmann::ordered_json in_short(const Report& report, const std::vector<bool>& full);
/// The findings that a report has in short; none if it has all rows. Throws as reported_row().
std::vector<Result> rows_in_short(const nlohmann::json& report);
/// One of its `causes`.
nlohmann::ordered_json cause_json(const Report& report, const Cause& cause, int number,
                                  const std::string& level);
/// A row of `results` again, as far as it has it: what is missing is as in an empty row. Throws
/// nlohmann::json::exception: a value is of another type; data::ArgumentError: a word means nothing.
Result reported_row(const nlohmann::json& row);

/// Rows to go on with and to merge: nothing is lost. Reading throws as reported_row().
nlohmann::json rows_json(const std::vector<Result>& rows);
std::vector<Result> rows_of(const nlohmann::json& json);
/// The receipts of subjects, and of several lists one after another those of the whole, one for each subject. Reading
/// also throws data::ArgumentError: a number is below 0 or absurd.
nlohmann::json receipts_json(const std::vector<Receipt>& receipts);
std::vector<Receipt> receipts_of(const nlohmann::json& json);
/// What a report says before its first row: version, depths, meshes, subjects.
nlohmann::json header_json(const Report& report);
Report header_of(const nlohmann::json& json);

/// An array, null for an empty list; of numbers that are not finite the words (verify/row/fields.h).
nlohmann::ordered_json numbers(const std::vector<double>& list);

/// Writes a text whole or not at all (data/io/atomic_file.h); makes the folder. Throws
/// std::filesystem::filesystem_error or data::InputError FILE_CANNOT_WRITE.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace limitcheck::verify
