// SPDX-License-Identifier: MIT
// --shard and --resume of the commands whose plan is done unit by unit.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "verify/shard/journal.h"
#include "verify/shard/part.h"

namespace limitcheck::cli {

struct ShardArguments {
  std::string json;  // the report, or the part of one; "-": standard output; empty: none
  std::string shard = "1/1";
  bool resume = false;

  verify::Shard of() const { return verify::parse_shard(shard); }
  /// Throws data::ArgumentError: --shard is nonsense, or --json is no file to keep it in.
  void check() const;
};

/// --shard and --resume.
///   units   what is dealt out: "meshes"
void add_shard_options(CLI::App& command, ShardArguments& arguments, const std::string& units);
/// --json [FILE]
void add_json_option(CLI::App& command, ShardArguments& arguments);

/// The journal of the plan, in FILE.jsonl beside the report FILE.json; without a file in memory only. Throws
/// data::ArgumentError: --resume, but there is nothing to resume, or it is of another plan or shard.
///   remember   false: results() of a journal of the whole in a file are not asked for
std::unique_ptr<verify::Journal> open_journal(const ShardArguments& arguments, verify::Plan plan,
                                              bool remember = true);

/// Writes the results of a shard to --json; `part` has the rest.
void write_part(const ShardArguments& arguments, const verify::Journal& journal, verify::PartReport part);

}  // namespace limitcheck::cli
