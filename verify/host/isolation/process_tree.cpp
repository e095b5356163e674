// SPDX-License-Identifier: MIT
#include "verify/host/isolation/process_tree.h"

#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace limitcheck::verify {
namespace {

namespace fs = std::filesystem;

// The folders in `folder` whose names are numbers. Processes come and go meanwhile.
std::vector<pid_t> numbers_in(const fs::path& folder) {
  std::vector<pid_t> numbers;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename();
    pid_t number = 0;
    const auto [rest, wrong] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (wrong == std::errc{} && rest == name.data() + name.size()) numbers.push_back(number);
  }
  return numbers;
}

bool lists_children(const fs::path& proc) {
  std::error_code ignored;
  return fs::exists(proc / "thread-self" / "children", ignored);
}

std::vector<pid_t> listed_children(pid_t process, const fs::path& proc) {
  std::vector<pid_t> children;
  const fs::path tasks = proc / std::to_string(process) / "task";
  for (const pid_t task : numbers_in(tasks)) {
    std::ifstream list(tasks / std::to_string(task) / "children");
    children.insert(children.end(), std::istream_iterator<pid_t>(list), {});
  }
  return children;
}

// Of all processes there are, by their parents.
std::map<pid_t, std::vector<pid_t>> all_children(const fs::path& proc) {
  std::map<pid_t, std::vector<pid_t>> children;
  for (const pid_t p : numbers_in(proc)) {
    std::ifstream in(proc / std::to_string(p) / "stat");
    std::string stat;
    std::getline(in, stat, '\0');
    // 42 (its name) S 1 ...: the name may be anything.
    const std::size_t name_end = stat.rfind(')');
    if (name_end == std::string::npos || name_end + 4 >= stat.size()) continue;
    pid_t parent = 0;
    std::from_chars(stat.data() + name_end + 4, stat.data() + stat.size(), parent);
    children[parent].push_back(p);
  }
  return children;
}

// Of these, `shared`: those of files and shared memory.
std::uint64_t resident_bytes(pid_t process, const fs::path& proc, std::uint64_t* shared = nullptr) {
  static const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  std::uint64_t size = 0, resident = 0, of_files = 0;
  std::ifstream(proc / std::to_string(process) / "statm") >> size >> resident >> of_files;
  if (shared != nullptr) *shared += of_files * page;
  return resident * page;
}

// The bytes of shared memory without a name by device and number: what several have counts once.
using Unnamed = std::map<std::pair<dev_t, ino_t>, std::uint64_t>;

void add_unnamed(const std::string& file, Unnamed& found) {
  struct stat is {};
  struct statfs system {};
  if (stat(file.c_str(), &is) == 0 && S_ISREG(is.st_mode) && is.st_nlink == 0 &&
      statfs(file.c_str(), &system) == 0 && system.f_type == TMPFS_MAGIC)
    found[{is.st_dev, is.st_ino}] = static_cast<std::uint64_t>(is.st_blocks) * 512;
}

void add_unnamed(pid_t process, const fs::path& proc, Unnamed& found) {
  const fs::path folder = proc / std::to_string(process);
  std::error_code error;
  for (fs::directory_iterator entry(folder / "fd", error), end; !error && entry != end;
       entry.increment(error))
    add_unnamed(entry->path(), found);
  // 7f0000000000-7f0000001000 rw-s 00000000 00:01 1    /memfd:name (deleted)
  std::ifstream maps(folder / "maps");
  for (std::string line; std::getline(maps, line);)
    if (line.ends_with(" (deleted)"))
      add_unnamed(folder / "map_files" / line.substr(0, line.find(' ')), found);
}

// What a file of a process says in KiB behind a word, if the system tells; otherwise what is resident: nothing if it
// has ended meanwhile.
std::uint64_t bytes_behind(std::string_view sought, const char* file, pid_t process, const fs::path& proc) {
  std::ifstream in(proc / std::to_string(process) / file);
  for (std::string word; in >> word;)
    if (std::uint64_t kib = 0; word == sought && in >> kib) return kib << 10;
  return resident_bytes(process, proc);
}

}  // namespace

std::vector<pid_t> children_of(pid_t process, const fs::path& proc) {
  return lists_children(proc) ? listed_children(process, proc) : all_children(proc)[process];
}

std::vector<pid_t> descendants(pid_t process, const fs::path& proc) {
  const bool listed = lists_children(proc);
  std::map<pid_t, std::vector<pid_t>> children;
  if (!listed) children = all_children(proc);
  std::vector<pid_t> found;
  std::size_t done = 0;
  for (pid_t parent = process;; parent = found[done++]) {
    for (const pid_t child : listed ? listed_children(parent, proc) : children[parent])
      if (std::find(found.begin(), found.end(), child) == found.end()) found.push_back(child);
    if (done == found.size()) return found;
  }
}

Held held_bytes(const std::vector<pid_t>& processes, std::uint64_t enough, const fs::path& proc) {
  Unnamed found;
  Held held;
  std::uint64_t resident = 0, of_files = 0;
  for (const pid_t p : processes) {
    add_unnamed(p, proc, found), resident += resident_bytes(p, proc, &of_files);
    held.most = std::max(held.most, bytes_behind("VmHWM:", "status", p, proc));
  }
  if (resident > enough && processes.size() > 1) {
    resident = 0;  // each page divided by the number of those who have it
    for (const pid_t p : processes) resident += bytes_behind("Pss:", "smaps_rollup", p, proc);
  }
  for (const auto& [file, bytes] : found) held.shared += bytes;
  // Some of it may be resident, too: that counts once.
  held.bytes = std::max(resident, resident - std::min(resident, of_files) + held.shared);
  return held;
}

}  // namespace limitcheck::verify
