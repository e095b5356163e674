// SPDX-License-Identifier: MIT
// Commands whose plan is done unit by unit: --json, --shard and --resume, and the reports that limitcheck merge makes
// of their parts.
#pragma once

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/io/whole_content.h"
#include "verify/cli/screen.h"
#include "verify/shard/shard.h"

namespace limitcheck::cli {

struct ShardArguments {
  std::string json;  // the report, or the part of one; "-": standard output; empty: none
  std::string shard = "1/1";
  bool resume = false;

  verify::Shard of() const { return verify::parse_shard(shard); }
  /// Throws data::ArgumentError: --shard is nonsense, or --json is no file to keep it in.
  void check() const;
};

/// --json [FILE]
void add_json_option(CLI::App& command, ShardArguments& arguments);
/// --shard and --resume.
///   units   what is dealt out: "meshes"
void add_shard_options(CLI::App& command, ShardArguments& arguments, const std::string& units);

/// The journal of the plan, in FILE.jsonl beside the report FILE.json; without a file in memory only. Throws
/// data::ArgumentError: --resume, but there is nothing to resume, or it is of another plan or shard.
///   remember   false: results() of a journal of the whole in a file are not asked for
std::unique_ptr<verify::Journal> open_journal(const ShardArguments& arguments, verify::Plan plan,
                                              bool remember = true);

/// Writes the results of a shard to --json; `part` has the rest.
void write_part(const ShardArguments& arguments, const verify::Journal& journal, verify::PartReport part);

/// Does the units of the shard that the journal does not know, and writes the part if it is one.
///   work     keeps the result of each unit; ends when it is interrupted (verify/interrupt/interrupt.h)
///   report   of what is done, which is all unless it says that it is incomplete; returns the exit code
int run_units(const ShardArguments& arguments, verify::Plan plan,
              const std::function<void(verify::Journal&, Progress&)>& work,
              const std::function<int(const verify::PartReport&)>& report);

/// In memory that all processes share.
struct JobCounters {
  std::atomic<std::uint64_t> cases, findings;
};

/// Runs work(0) .. work(jobs - 1), each in a process of its own, and waits; calls `show` about ten times a
/// second. A signal that is noted (interrupt.h) is handed on to all. To be called before this process has
/// threads. Returns the largest exit code, or 128 plus the number of the signal that killed one of them.
///   work   returns its exit code; ends by itself when it is interrupted. The processes end with this one.
int run_jobs(int jobs, const std::function<int(int, JobCounters&)>& work,
             const std::function<void(const JobCounters&)>& show);

/// read(text) of a file; of what is wrong with it data::ArgumentError says in which file, too.
template <class Read>
auto read_file(const std::string& file, const Read& read) try {
  return read(data::io::whole_content(file));
} catch (const data::ArgumentError& error) {
  throw data::ArgumentError(fmt::format("{}: {}", file, error.what()));
}

/// SHA-256 of the bytes; empty: there is no such file.
std::string file_digest(const std::string& file);

/// The report, a JSON object, with what it is of in front ("attested": the digests of this program, of the plan and, as
/// far as the plan has them, of subjects and meshes) and a digest of all of it (verify/shard/shard.h).
std::string attested(std::string report, const nlohmann::json& plan);

/// What limitcheck prove is asked for: limitcheck knows the options, and hands them over to limitcheck-prove, which does
/// it.
struct ProveRequest {
  std::string scheme = "loop", valences, kernel = "all", set = "standard";
  int depth = 0;
  bool each = false;
  ShardArguments shard;
  std::vector<std::string> parts;  // of limitcheck merge
};
void add_prove(CLI::App& app, const std::function<void(const ProveRequest&)>& prove);

/// The report of limitcheck mutants; to `json` it goes as with --json. Returns the exit code.
int report_mutants(const verify::PartReport& done, const std::string& json);

}  // namespace limitcheck::cli
