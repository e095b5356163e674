// SPDX-License-Identifier: MIT
#include "data/io/atomic_file.h"

#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "data/error.h"

namespace limitcheck::data {

namespace {

constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};

// What the handler removes. It may only touch what is lock-free and async-signal-safe.
std::array<char, 4096> doomed_name;
std::atomic<bool> doomed{false};
static_assert(std::atomic<bool>::is_always_lock_free);
std::array<struct sigaction, kSignals.size()> before;

extern "C" void remove_and_go_on(int signal) {
  if (doomed.load()) unlink(doomed_name.data());
  // SA_RESETHAND has put the default action back: raised again, the signal ends the process as it would have.
  raise(signal);
}

void arm(const std::filesystem::path& file) {
  if (file.native().size() >= doomed_name.size()) return;
  std::memcpy(doomed_name.data(), file.c_str(), file.native().size() + 1);
  doomed = true;
  struct sigaction action {};
  action.sa_handler = remove_and_go_on;
  action.sa_flags = SA_RESETHAND | SA_NODEFER;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before[i]);
    if (before[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &action, nullptr);
  }
}

void disarm() {
  if (!doomed.exchange(false)) return;
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before[i], nullptr);
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path file) : file_(std::move(file)), buffer_(1 << 20) {
  std::error_code error;
  // Through a link, as any program that opens it would, rather than in its place.
  if (std::filesystem::is_symlink(file_, error))
    if (auto target = std::filesystem::canonical(file_, error); !error) file_ = std::move(target);
  const auto type = std::filesystem::status(file_, error).type();
  if (type == std::filesystem::file_type::not_found || type == std::filesystem::file_type::regular) {
    temporary_ = file_.string() + fmt::format(".partial-{}", getpid());
    arm(temporary_);
  }
  errno = 0;
  stream_.rdbuf()->pubsetbuf(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  stream_.open(temporary_.empty() ? file_ : temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_) refuse();
  // What takes the place of a file is as private as that was.
  if (type == std::filesystem::file_type::regular)
    std::filesystem::permissions(temporary_, std::filesystem::status(file_, error).permissions(), error);
}

AtomicFile::~AtomicFile() {
  stream_.close();
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
  disarm();
}

void AtomicFile::commit() {
  errno = 0;
  stream_.close();
  if (!stream_) refuse();
  if (temporary_.empty()) return;
  std::error_code error;
  std::filesystem::rename(temporary_, file_, error);
  if (error) {
    errno = error.value();
    refuse();
  }
  temporary_.clear();
  disarm();
}

void AtomicFile::refuse() {
  const std::string why = errno != 0 ? std::strerror(errno) : "cannot be written";
  stream_.close();
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
  disarm();
  throw InputError("FILE_CANNOT_WRITE", file_.string(), 0, why);
}

}  // namespace limitcheck::data
