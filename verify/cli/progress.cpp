// SPDX-License-Identifier: MIT
#include "verify/cli/progress.h"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

namespace limitcheck::cli {
namespace {

constexpr std::size_t kBar = 24;

std::size_t terminal_width(std::FILE* stream) {
  winsize size{};
  return ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

Progress::Progress() : terminal_(isatty(STDERR_FILENO) != 0) {}

void Progress::show(std::size_t done, std::size_t total, const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || (shown_ && now - last_ < std::chrono::milliseconds(100))) return;
  last_ = now;
  shown_ = true;
  const std::size_t filled = total == 0 ? 0 : std::min(kBar, kBar * done / total);
  std::string line = fmt::format("[{}{}] {}/{} {}", std::string(filled, '#'), std::string(kBar - filled, '.'),
                                 done, total, text);
  line.resize(std::min(line.size(), terminal_width(stream_) - 1));
  fmt::print(stream_, "\r\033[K{}", line);
  std::fflush(stream_);
}

void Progress::clear() {
  if (terminal_ && shown_) fmt::print(stream_, "\r\033[K");
  shown_ = false;
}

}  // namespace limitcheck::cli
