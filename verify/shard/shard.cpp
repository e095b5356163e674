// SPDX-License-Identifier: MIT
#include "verify/shard/shard.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sha2.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

#include "data/error.h"
#include "data/io/whole_content.h"
#include "data/numeral.h"
#include "data/untrusted_json.h"

namespace limitcheck::verify {
namespace {

using Json = nlohmann::json;

std::string digest_of(const Json& object) {
  return digest(object.dump(-1, ' ', false, Json::error_handler_t::replace));
}

Json to_json(const Plan& plan) {
  return {{"program", plan.program},
          {"plan", plan.what},
          {"units", plan.units},
          {"together", plan.together},
          {"shard", plan.shard.text()}};
}

int opened(const std::filesystem::path& file, int flags) {
  // Not through a link: it would write into a file that is none of ours.
  return open(file.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | flags, 0666);
}

}  // namespace

Shard parse_shard(const std::string& text) {
  Shard shard;
  std::uint64_t k = 0;
  if (data::read_numbers(text, '/', k, shard.count) != 2 || k < 1 || k > shard.count ||
      shard.count > 1'000'000)
    throw data::ArgumentError(fmt::format("--shard {}: K/N with 1 <= K <= N, for example 3/8", text));
  shard.index = k - 1;
  return shard;
}

void require_all(const std::vector<Shard>& shards) {
  if (shards.empty()) throw data::ArgumentError("there is nothing to merge");
  const std::uint64_t count = shards.front().count;
  std::set<std::uint64_t> there;
  for (const Shard& s : shards) {
    if (s.count != count)
      throw data::ArgumentError(fmt::format("shard {} is not of {} shards", s.text(), count));
    if (!there.insert(s.index).second)
      throw data::ArgumentError(fmt::format("shard {} is there twice", s.text()));
  }
  for (std::uint64_t k = 0; k < count; ++k)
    if (!there.contains(k))
      throw data::ArgumentError(fmt::format("shard {} is missing", Shard{k, count}.text()));
}

bool PartReport::is_complete() const {
  // Not a walk through the units of the plan: a file that somebody wrote may tell of 10^18.
  return results.size() == plan.size() && std::ranges::all_of(results, [&](const auto& r) {
           return r.first < plan.units && plan.has(r.first);
         });
}

std::string to_json(const PartReport& part) {
  Json results = Json::array();
  for (const auto& [unit, result] : part.results) results.push_back({unit, result});
  Json json = to_json(part.plan);
  json.update({{"seconds", part.seconds},
               {"containment", part.containment},
               {"printed", part.printed},
               {"incomplete", part.incomplete},
               {"devices", part.devices},
               {"receipts", part.receipts},
               {"results", std::move(results)}});
  return sealed(json);
}

PartReport read_part(const std::string& text) try {
  Json json = data::parse_untrusted(text);
  if (!json.contains("shard") || !json.contains("together"))
    throw data::ArgumentError("this is no part that --shard has made");
  json = unsealed_object(std::move(json));
  PartReport part;
  json.at("program").get_to(part.plan.program);
  part.plan.what = std::move(json.at("plan"));
  data::read_value(json.at("units"), part.plan.units),
      data::read_value(json.at("together"), part.plan.together);
  part.plan.shard = parse_shard(json.at("shard").get<std::string>());
  json.at("seconds").get_to(part.seconds), json.at("containment").get_to(part.containment);
  json.at("printed").get_to(part.printed), json.at("incomplete").get_to(part.incomplete);
  if (json.contains("devices")) json.at("devices").get_to(part.devices);
  if (json.contains("receipts")) part.receipts = std::move(json.at("receipts"));
  if (!part.receipts.is_array() || part.plan.together == 0)
    throw data::ArgumentError("this is no part that --shard has made");
  for (Json& pair : json.at("results"))
    if (!part.results.emplace(data::value_of<std::size_t>(pair.at(0)), std::move(pair.at(1))).second)
      throw data::ArgumentError("it has a unit twice");
  return part;
} catch (const Json::exception& error) {
  throw data::ArgumentError(fmt::format("this is no part that --shard has made: {}", error.what()));
}

PartReport joined(const std::vector<PartReport>& parts) {
  std::vector<Shard> shards;
  for (const PartReport& p : parts) {
    shards.push_back(p.plan.shard);
    const Plan& first = parts.front().plan;
    const auto refuse = [&](const std::string& why) {
      throw data::ArgumentError(fmt::format("shard {} {}", p.plan.shard.text(), why));
    };
    if (p.plan.program != first.program || p.plan.what != first.what || p.plan.units != first.units ||
        p.plan.together != first.together)
      refuse("is of another plan than shard " + first.shard.text());
    if (!p.incomplete.empty()) refuse("is incomplete: " + p.incomplete);
    if (!p.is_complete()) refuse("is incomplete");
  }
  require_all(shards);
  PartReport whole;
  whole.plan = parts.front().plan, whole.plan.shard = {};
  std::map<std::uint64_t, const PartReport*> in_order;
  for (const PartReport& p : parts) in_order[p.plan.shard.index] = &p;
  for (const auto& [index, part] : in_order) {
    const PartReport& p = *part;
    whole.results.insert(p.results.begin(), p.results.end());
    whole.seconds += p.seconds;
    whole.printed += p.printed;
    whole.receipts.insert(whole.receipts.end(), p.receipts.begin(), p.receipts.end());
    whole.devices.insert(p.devices.begin(), p.devices.end());
    if (whole.containment.empty()) whole.containment = p.containment;
  }
  return whole;
}

std::size_t Plan::size() const {
  const std::size_t blocks = units / together + (units % together != 0 ? 1 : 0);
  if (shard.index >= blocks) return 0;
  const std::size_t mine = (blocks - 1 - shard.index) / shard.count + 1;
  const bool last = shard.has(blocks - 1);  // which may be a smaller one
  return last ? (mine - 1) * together + (units - (blocks - 1) * together) : mine * together;
}

Journal::Journal(Plan plan, std::filesystem::path file, bool resume, bool remember)
    : plan_(std::move(plan)), file_(std::move(file)), remember_(remember) {
  if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path());
  const auto refuse = [&](const std::string& why) { throw data::ArgumentError(why); };
  const std::string name = file_.string();
  const int descriptor = opened(file_, resume ? 0 : O_CREAT | O_EXCL);
  if (descriptor < 0 && errno == EEXIST)
    refuse(name +
           " is there: a journal that --resume goes on with, or somebody else's file. Delete it if it is "
           "neither");
  if (descriptor < 0 && resume)
    refuse(errno == ENOENT ? fmt::format("--resume: there is no {}", name)
                           : fmt::format("--resume: {}: {}", name, std::strerror(errno)));
  if (descriptor < 0) return;  // the work goes on without it
  out_.reset(fdopen(descriptor, "r+"));
  // The jobs of a run that was killed end a moment after it, and hold its journals until then.
  const auto start = std::chrono::steady_clock::now();
  while (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (!resume || std::chrono::steady_clock::now() - start > std::chrono::seconds(10))
      refuse(name + ": another run is writing it");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  if (resume)
    read();
  else
    write(sealed(to_json(plan_)));
}

void Journal::read() {
  const auto refuse = [&](const std::string& why) {
    throw data::ArgumentError(fmt::format("--resume: {}{}", file_.string(), why));
  };
  struct stat is {};
  if (fstat(fileno(out_.get()), &is) != 0 || !S_ISREG(is.st_mode)) refuse(" is no file");
  const std::string text = data::io::whole_content(file_);
  const std::string first = sealed(to_json(plan_));
  if (text.size() < first.size() && first.starts_with(text)) {  // a kill came before it was whole
    if (ftruncate(fileno(out_.get()), 0) != 0) refuse(": it cannot be written");
    return write(first);
  }
  if (!text.starts_with(first))
    refuse(" is of another plan: of other subjects, meshes, options or another shard");
  // What a kill has torn is the end of the file, behind the last line that is whole; whole lines are true.
  std::size_t begin = first.size(), line = 2;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1, ++line) try {
      Json json = unsealed(std::string_view(text).substr(begin, end - begin));
      const auto unit = data::value_of<std::size_t>(json.at("unit"));
      if (unit >= plan_.units || !plan_.has(unit))
        refuse(fmt::format(":{}: unit {} is not of this plan", line, unit));
      if (!results_.emplace(unit, std::move(json.at("result"))).second)
        refuse(fmt::format(":{}: unit {} is there twice", line, unit));
      if (json.contains("receipts")) before_ = std::move(json.at("receipts"));
    } catch (const Json::exception& error) {
      refuse(fmt::format(":{}: {}", line, error.what()));
    } catch (const data::ArgumentError& error) {
      refuse(fmt::format(":{}: {}", line, error.what()));
    }
  if (ftruncate(fileno(out_.get()), static_cast<off_t>(begin)) != 0) refuse(": it cannot be written");
  std::fseek(out_.get(), 0, SEEK_END);
}

void Journal::reload() {
  if (!std::filesystem::exists(file_)) throw data::ArgumentError(file_.string() + " cannot be written");
  results_.clear();
  read();
}

void Journal::write(const std::string& line) {
  if (!out_) return;
  const bool written = std::fwrite(line.data(), 1, line.size(), out_.get()) == line.size();
  if (!written || std::fflush(out_.get()) != 0) remove();  // half a line is of no use
}

const Json* Journal::recall(std::size_t unit) const {
  const auto found = results_.find(unit);
  return found == results_.end() ? nullptr : &found->second;
}

void Journal::keep(std::size_t unit, Json result) {
  Json line{{"unit", unit}, {"result", result}};
  if (receipts_) line["receipts"] = receipts_();
  if (out_) write(sealed(line));
  if (remember_) results_[unit] = std::move(result);
}

void Journal::remove() {
  if (!out_) return;
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
  out_.reset();
}

std::string digest(std::string_view bytes) {
  SHA2_CTX context;
  SHA256Init(&context);
  SHA256Update(&context, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  std::array<char, SHA256_DIGEST_STRING_LENGTH> text{};
  SHA256End(&context, text.data());
  return text.data();
}

std::string sealed(const std::string& object_text) {
  return fmt::format("{{\"digest\":\"{}\",{}\n", digest_of(data::parse_untrusted(object_text)),
                     std::string_view(object_text).substr(1));
}

nlohmann::json unsealed(std::string_view text, bool digest_may_lack) {
  return unsealed_object(data::parse_untrusted(text), digest_may_lack);
}

nlohmann::json unsealed_object(nlohmann::json json, bool digest_may_lack) {
  if (!json.is_object()) throw data::ArgumentError("it is no JSON object, or is cut short");
  const auto found = json.find("digest");
  if (found == json.end()) {
    if (digest_may_lack) return json;
    throw data::ArgumentError("it has no digest");
  }
  const nlohmann::json said = *found;
  json.erase(found);
  if (!said.is_string() || said.get_ref<const std::string&>() != digest_of(json))
    throw data::ArgumentError("it was altered or damaged after it was written: its digest is another one");
  return json;
}

}  // namespace limitcheck::verify
