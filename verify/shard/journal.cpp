// SPDX-License-Identifier: MIT
#include "verify/shard/journal.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "data/error.h"
#include "data/io/whole_content.h"
#include "verify/shard/seal.h"

namespace limitcheck::verify {
namespace {

using Json = nlohmann::json;

int opened(const std::filesystem::path& file, int flags) {
  // Not through a link: it would write into a file that is none of ours.
  return open(file.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | flags, 0666);
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
  return sealed(Json{{"program", plan_.program},
                     {"plan", plan_.what},
                     {"units", plan_.units},
                     {"together", plan_.together},
                     {"shard", plan_.shard.text()}});
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
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) refuse(name + ": another run is writing it");
  if (resume)
    read();
  else
    write(first_line());
}

void Journal::read() {
  const auto refuse = [&](const std::string& why) {
    throw data::ArgumentError(fmt::format("--resume: {}{}", file_.string(), why));
  };
  struct stat is {};
  if (fstat(fileno(out_.get()), &is) != 0 || !S_ISREG(is.st_mode)) refuse(" is no file");
  const std::string text = data::io::whole_content(file_);
  const std::string first = first_line();
  if (!text.starts_with(first))
    refuse(" is of another plan: of other subjects, meshes, options or another shard");
  // What a kill has torn is the end of the file, behind the last line that is whole; whole lines are true.
  std::size_t begin = first.size(), line = 2;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1, ++line) try {
      Json json = unsealed(std::string_view(text).substr(begin, end - begin));
      const auto unit = json.at("unit").get<std::size_t>();
      if (unit >= plan_.units || !plan_.has(unit))
        refuse(fmt::format(":{}: unit {} is not of this plan", line, unit));
      if (!results_.emplace(unit, std::move(json.at("result"))).second)
        refuse(fmt::format(":{}: unit {} is there twice", line, unit));
    } catch (const Json::exception& error) {
      refuse(fmt::format(":{}: {}", line, error.what()));
    } catch (const data::ArgumentError& error) {
      refuse(fmt::format(":{}: {}", line, error.what()));
    }
  if (ftruncate(fileno(out_.get()), static_cast<off_t>(begin)) != 0) refuse(": it cannot be written");
  std::fseek(out_.get(), 0, SEEK_END);
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
  if (out_) write(sealed(Json{{"unit", unit}, {"result", result}}));
  if (remember_) results_[unit] = std::move(result);
}

void Journal::remove() {
  if (!out_) return;
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
  out_.reset();
}

}  // namespace limitcheck::verify
