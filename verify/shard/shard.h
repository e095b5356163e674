// SPDX-License-Identifier: MIT
// A part of work that is done in many processes or on many machines.
// What is done so far of a plan, on the disk before the next unit begins: whatever ends the program, the work
// can be resumed.
// The report of one shard: its results as they are, for the report of the whole to be made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace limitcheck::verify {

/// Of units of work that are numbered from 0 on every `count`-th, from unit `index` on.
struct Shard {
  std::uint64_t index = 0, count = 1;

  bool has(std::uint64_t unit) const { return unit % count == index; }
  bool is_whole() const { return count == 1; }
  /// "3/8": the third of eight.
  std::string text() const { return std::to_string(index + 1) + "/" + std::to_string(count); }

  friend bool operator==(const Shard&, const Shard&) = default;
};

/// Throws data::ArgumentError for anything but "K/N" with 1 <= K <= N.
Shard parse_shard(const std::string& text);

/// Throws data::ArgumentError unless these are all shards of one whole, each once.
void require_all(const std::vector<Shard>& shards);

/// What is to be done: the same in all shards.
struct Plan {
  std::string program;       // "limitcheck audit"
  nlohmann::json what;       // all that decides the results: subjects, meshes, options, version
  std::size_t units = 0;     // numbered from 0 on
  std::size_t together = 1;  // so many units after another belong to one shard
  Shard shard = {};

  bool has(std::size_t unit) const { return shard.has(unit / together); }
  /// How many units the shard has.
  std::size_t size() const;
};

/// The results of units, by number; in a file of JSON lines, too, if there is one. The first line says what
/// is done, each other line holds one unit: {"unit", "result"}; each line is sealed. A line is written
/// whole and flushed. If the file cannot be written, the work goes on without it. The file is locked.
class Journal {
 public:
  /// In memory only.
  explicit Journal(Plan plan) : plan_(std::move(plan)) {}
  /// Begins a new file. With `resume`, reads the lines of an existing file and appends to them; what is torn
  /// behind the last whole line is cut off. Throws data::ArgumentError: there is such a file already, a link or another
  /// run's; with `resume`, there is none, it is of another plan or shard, or a line was altered.
  ///   remember   false: results() need not have what is kept from now on
  Journal(Plan plan, std::filesystem::path file, bool resume, bool remember = true);

  const Plan& plan() const { return plan_; }
  /// nullptr: it is not done.
  const nlohmann::json* recall(std::size_t unit) const;
  void keep(std::size_t unit, nlohmann::json result);
  /// Has what this returns written with each result from now on, under "receipts". Before that it is what the last line
  /// that was read has there, or null.
  void attach(std::function<nlohmann::json()> receipts) { receipts_ = std::move(receipts); }
  const nlohmann::json& receipts_before() const { return before_; }
  /// Reads the file again, which other processes may have added to. Throws data::ArgumentError: as with `resume`, or the
  /// file could not be written.
  void reload();
  /// All that is there.
  const std::map<std::size_t, nlohmann::json>& results() const { return results_; }
  /// Deletes the file.
  void remove();

 private:
  void read();
  void write(const std::string& line);

  Plan plan_;
  std::filesystem::path file_;
  bool remember_ = true;
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> out_;
  std::map<std::size_t, nlohmann::json> results_;
  std::function<nlohmann::json()> receipts_;
  nlohmann::json before_;
};

struct PartReport {
  Plan plan;
  std::map<std::size_t, nlohmann::json> results;  // by unit
  double seconds = 0;
  std::string containment, printed;            // as in Report (verify/row/result.h)
  std::string incomplete;                      // why not all of the shard is done; empty: all is
  std::map<std::string, std::string> devices;  // as in Report
  // What subjects took: an array, and of the whole those of all parts (receipts_of in verify/report/json.h).
  nlohmann::json receipts = nlohmann::json::array();

  /// Whether each unit of the shard is there, and no other.
  bool is_complete() const;
};

/// Keys: program, plan, units, together, shard, seconds, containment, printed, incomplete, devices, receipts, results
/// (pairs of unit and result).
std::string to_json(const PartReport& part);
/// Throws data::ArgumentError: the text is no part.
PartReport read_part(const std::string& text);

/// All results, with the seconds of all shards and what they printed. Throws data::ArgumentError: they are
/// of different plans, or a shard is missing, there twice, or incomplete.
PartReport joined(const std::vector<PartReport>& parts);

/// SHA-256 of the bytes, 64 hexadecimal digits.
std::string digest(std::string_view bytes);

/// The text of a JSON object with the key "digest" before its own: the digest of the object without it, its keys in
/// order and without white space. Ends with a new line.
///   indent   as nlohmann::json::dump: -1 for one line
std::string sealed(const std::string& object_text);
template <class Json>
std::string sealed(const Json& object, int indent = -1) {
  return sealed(object.dump(indent, ' ', false, Json::error_handler_t::replace));
}

/// The object without its digest. Throws data::ArgumentError: it is no JSON object, has no digest (unless that
/// may lack, in files of before 0.2), or another one than the text has now.
nlohmann::json unsealed_object(nlohmann::json object, bool digest_may_lack = false);
nlohmann::json unsealed(std::string_view text, bool digest_may_lack = false);

}  // namespace limitcheck::verify
