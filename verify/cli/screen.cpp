// SPDX-License-Identifier: MIT
#include "verify/cli/screen.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include "verify/row/visible_text.h"

namespace limitcheck::cli {
namespace {

constexpr std::size_t kBar = 24, kNarrow = 40;

constexpr int kFatal[] = {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};
constexpr std::size_t kFatals = std::size(kFatal);
int kept_file = -1, real_error = -1;
struct sigaction before[kFatals];  // a sanitizer has its own

// Only calls that are allowed in a handler.
void show_the_end(int signal) {
  constexpr off_t kShown = 2000;
  char text[kShown];
  const off_t size = lseek(kept_file, 0, SEEK_END);
  const ssize_t count = pread(kept_file, text, kShown, size > kShown ? size - kShown : 0);
  for (ssize_t k = 0; k < count; ++k)  // no escape sequence of the subject's
    if (static_cast<unsigned char>(text[k]) < 0x20 && text[k] != '\n') text[k] = ' ';
  if (count > 0) (void)!write(real_error, text, static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < kFatals; ++k)
    if (kFatal[k] == signal) sigaction(signal, &before[k], nullptr);
  (void)raise(signal);
}

}  // namespace

std::size_t screen_width(int fd) {
  constexpr std::size_t kLeast = 40, kMost = 1000;
  winsize size{};
  if (ioctl(fd, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return std::max<std::size_t>(size.ws_col, kLeast);
  const char* columns = std::getenv("COLUMNS");
  const std::string_view text = columns == nullptr ? "" : columns;
  std::size_t width = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), width);
  if (error != std::errc() || end != text.data() + text.size() || width == 0) return 0;
  return std::clamp(width, kLeast, kMost);
}

bool takes_escapes(int fd) {
  const char* kind = std::getenv("TERM");
  return isatty(fd) != 0 && (kind == nullptr || std::string_view(kind) != "dumb");
}

Progress::Progress(std::chrono::milliseconds between)
    : terminal_(takes_escapes(STDERR_FILENO)),
      between_(terminal_ ? std::chrono::milliseconds(100) : between) {}

void Progress::show(std::size_t done, std::size_t total, const std::string& text) {
  const auto now = Clock::now();
  if (now - last_ < between_ && (shown_ || !terminal_)) return;
  last_ = now;
  std::string left;
  if (done > 0 && done < total) {
    const double seconds = std::chrono::duration<double>(now - start_).count();
    left = fmt::format(", {:.0f} s left",
                       seconds * static_cast<double>(total - done) / static_cast<double>(done));
  }
  if (!terminal_) {
    fmt::print(stream_, "{}\n",
               verify::visible_text(fmt::format("limitcheck: {}/{}{}: {}", done, total, left, text)));
    std::fflush(stream_);
    return;
  }
  shown_ = true;
  const std::size_t filled = total == 0 ? 0 : std::min(kBar, kBar * done / total);
  std::string line =
      verify::visible_text(fmt::format("[{}{}] {}/{}{} {}", std::string(filled, '#'),
                                       std::string(kBar - filled, '.'), done, total, left, text));
  line.resize(std::min(line.size(), std::max<std::size_t>(screen_width(fileno(stream_)), kNarrow) - 1));
  fmt::print(stream_, "\r\033[K{}", line);
  std::fflush(stream_);
}

void Progress::clear() {
  if (terminal_ && shown_) fmt::print(stream_, "\r\033[K");
  shown_ = false;
}

SubjectOutput::SubjectOutput(Progress* progress) : progress_(progress) {
  std::fflush(stdout);
  std::fflush(stderr);
  file_ = memfd_create("output of subjects", MFD_CLOEXEC);
  const int screen = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  screen_ = screen < 0 ? nullptr : fdopen(screen, "w");
  if (progress_ != nullptr && screen_ != nullptr) progress_->to(screen_);
  if (file_ < 0) return;  // then they print to the screen
  out_ = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  error_ = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (out_ >= 0) dup2(file_, STDOUT_FILENO);
  if (error_ >= 0) dup2(file_, STDERR_FILENO);
  kept_file = file_;
  real_error = error_;
  struct sigaction action {};
  action.sa_handler = show_the_end;
  for (std::size_t k = 0; error_ >= 0 && k < kFatals; ++k) sigaction(kFatal[k], &action, &before[k]);
}

std::string SubjectOutput::take() {
  if (progress_ != nullptr) {
    progress_->clear();
    progress_->to(stderr);
  }
  if (screen_ != nullptr) std::fclose(std::exchange(screen_, nullptr));
  if (file_ < 0) return "";
  std::fflush(stdout);
  std::fflush(stderr);
  for (std::size_t k = 0; error_ >= 0 && k < kFatals; ++k) sigaction(kFatal[k], &before[k], nullptr);
  if (out_ >= 0) dup2(out_, STDOUT_FILENO);
  if (error_ >= 0) dup2(error_, STDERR_FILENO);
  for (int* fd : {&out_, &error_})
    if (*fd >= 0) close(std::exchange(*fd, -1));
  const off_t size = lseek(file_, 0, SEEK_END);
  std::string text(std::min(static_cast<std::size_t>(std::max<off_t>(size, 0)), kLongest), '\0');
  const ssize_t count = pread(file_, text.data(), text.size(), 0);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  close(std::exchange(file_, -1));
  return text;
}

}  // namespace limitcheck::cli
