// SPDX-License-Identifier: MIT
#include "verify/shard/journal.h"

#include <fmt/core.h>

#include <system_error>
#include <utility>

#include "data/error.h"

namespace limitcheck::verify {
namespace {

using Json = nlohmann::json;

std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::size_t Plan::size() const {
  const std::size_t blocks = units / together + (units % together != 0 ? 1 : 0);
  if (shard.index >= blocks) return 0;
  const std::size_t mine = (blocks - 1 - shard.index) / shard.count + 1;
  const bool last = shard.has(blocks - 1);  // which may be a smaller one
  return last ? (mine - 1) * together + (units - (blocks - 1) * together) : mine * together;
}

std::string Journal::first_line() const {
  return line_of({{"program", plan_.program},
                  {"plan", plan_.what},
                  {"units", plan_.units},
                  {"together", plan_.together},
                  {"shard", plan_.shard.text()}});
}

Journal::Journal(Plan plan, std::filesystem::path file, bool resume, bool remember)
    : plan_(std::move(plan)), file_(std::move(file)), remember_(remember) {
  if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path());
  std::string kept = first_line();
  if (resume) {
    std::ifstream in(file_, std::ios::binary);
    std::string line;
    if (!std::getline(in, line))
      throw data::ArgumentError(fmt::format("--resume: there is no {}", file_.string()));
    if (line + "\n" != kept)
      throw data::ArgumentError(
          fmt::format("--resume: {} is of another plan: of other subjects, meshes, options or another shard",
                      file_.string()));
    while (std::getline(in, line) && !in.eof()) {
      Json json = Json::parse(line, nullptr, false);
      if (!json.is_object() || !json.contains("result") || !json.value("unit", Json()).is_number_unsigned())
        break;
      results_[json.at("unit").get<std::size_t>()] = std::move(json.at("result"));
      kept += line + "\n";
    }
  }
  out_.open(file_, std::ios::binary | std::ios::trunc);
  out_ << kept << std::flush;
}

const Json* Journal::recall(std::size_t unit) const {
  const auto found = results_.find(unit);
  return found == results_.end() ? nullptr : &found->second;
}

void Journal::keep(std::size_t unit, Json result) {
  if (!file_.empty()) {
    out_ << line_of({{"unit", unit}, {"result", result}}) << std::flush;
    if (!out_) remove();  // half a line is of no use
  }
  if (remember_) results_[unit] = std::move(result);
}

void Journal::remove() {
  if (file_.empty()) return;
  out_.close();
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

}  // namespace limitcheck::verify
