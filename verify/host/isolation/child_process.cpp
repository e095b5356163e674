// SPDX-License-Identifier: MIT
#include "verify/host/isolation/child_process.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

#include "verify/host/isolation/process_tree.h"
#include "verify/interrupt/interrupt.h"

namespace limitcheck::verify {
namespace {

using namespace std::chrono_literals;
constexpr auto kTick = 20ms;   // between two looks at clock and memory
constexpr auto kGrace = 2s;    // to end in after the pipes are closed
constexpr auto kToBury = 10s;  // for the kernel to end what was killed, on a machine that is busy elsewhere
constexpr std::size_t kErrorTail = 2000;

[[noreturn]] void refuse(const char* what) {
  throw HostLacks{fmt::format("{}: {}", what, std::strerror(errno))};
}

// write(), without the SIGPIPE that would end this program if the reader is gone.
ssize_t write_quietly(int fd, std::string_view bytes) {
  sigset_t pipe, before, pending;
  sigemptyset(&pipe);
  sigaddset(&pipe, SIGPIPE);
  sigpending(&pending);
  pthread_sigmask(SIG_BLOCK, &pipe, &before);
  const ssize_t n = ::write(fd, bytes.data(), bytes.size());
  const int error = errno;
  if (n < 0 && error == EPIPE && sigismember(&pending, SIGPIPE) == 0) {
    const timespec now{0, 0};
    while (sigtimedwait(&pipe, nullptr, &now) < 0 && errno == EINTR) {
    }
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = error;
  return n;
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) {
    const char* name = sigabbrev_np(WTERMSIG(status));
    return fmt::format("killed by SIG{} ({})", name != nullptr ? name : "?", strsignal(WTERMSIG(status)));
  }
  const int code = WEXITSTATUS(status);
  const char* name = code > 128 ? sigabbrev_np(code - 128) : nullptr;
  return fmt::format("ended with exit status {}{}", code,
                     name == nullptr ? "" : fmt::format(" (a shell says so of SIG{})", name));
}

// Whether namespaces are available is found out once, with the first child.
std::atomic<bool> no_namespaces{false};

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const ProcessLimits& limits,
                           Receipt* receipt)
    : limits_(limits), receipt_(receipt != nullptr ? *receipt : unread_) {
  KeeperPipes theirs;
  const auto close_theirs = [&theirs] {
    for (const int fd : theirs.end)
      if (fd >= 0) ::close(fd);
  };
  for (const Pipe pipe : kPipes) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
      close_theirs();
      kill_and_reap();
      refuse("cannot make a pipe");
    }
    const bool they_read = pipe == kIn || pipe == kLifeline;
    theirs.end[pipe] = ends[they_read ? 0 : 1];
    pipe_[pipe] = ends[they_read ? 1 : 0];
    fcntl(pipe_[pipe], F_SETFL, O_NONBLOCK);
  }
  for (const Containment how : {Containment::kNamespace, Containment::kSubreaper}) {
    if (alive() || (how == Containment::kNamespace && (!limits.namespaces || no_namespaces))) continue;
    containment_ = how;
    keeper_ = start_keeper(how, command, theirs);
  }
  const int error = errno;
  close_theirs();
  if (!alive()) {
    kill_and_reap();
    errno = error;
    refuse("cannot start a process");
  }
  if (limits.namespaces) no_namespaces = containment_ == Containment::kSubreaper;
  start_clock();
  ++receipt_.processes;
}

void ChildProcess::close_pipe(Pipe pipe) {
  if (pipe_[pipe] >= 0) ::close(pipe_[pipe]);
  pipe_[pipe] = -1;
}

void ChildProcess::take(const News& news) {
  if (news.kind == News::kGivesUp) {
    kill_and_reap();
    errno = news.value;
    refuse("cannot start a process");
  }
  if (news.kind == News::kNotStarted) {
    not_started_ = true;
    errors_ += fmt::format("{}\n", std::strerror(news.value));
  }
  if (news.kind == News::kEnded) status_ = news.value;
}

// Whether the child ends until then. Throws SubjectDied if its keeper ends without a word.
bool ChildProcess::wait_for_end(Clock::time_point until) {
  for (;;) {
    siginfo_t info{};
    const bool last = waitid(P_PID, static_cast<id_t>(keeper_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
                      info.si_pid == keeper_;
    for (News news; ::read(pipe_[kNews], &news, sizeof news) == sizeof news;) take(news);
    if (status_) return true;
    if (last) fail(SubjectDied::Kind::kCrash, "the process that holds it was killed");
    if (Clock::now() > until) return false;
    drain_errors();
    pollfd news{pipe_[kNews], POLLIN, 0};
    ::poll(&news, 1, 5);
  }
}

// Every wait is limited: a process that the kernel cannot end is left to it.
void ChildProcess::kill_and_reap() {
  if (keeper_ > 0) {
    close_pipe(kIn);
    close_pipe(kLifeline);
    const auto reap = [this](Clock::duration patience) {
      for (const auto until = Clock::now() + patience; waitpid(keeper_, nullptr, WNOHANG) == 0;
           std::this_thread::sleep_for(500us))
        if (Clock::now() > until) return false;
      return true;
    };
    // A subreaper has to kill its children first; a namespace ends with its first process.
    if (containment_ == Containment::kNamespace || !reap(kGrace)) {
      kill(keeper_, SIGKILL);
      if (!reap(interrupted() != 0 ? Clock::duration(kGrace) : Clock::duration(kToBury)))
        epitaph_ += "; it cannot be killed, and is left to the system";
    }
    keeper_ = -1;
    drain_errors();
  }
  for (const Pipe pipe : kPipes) close_pipe(pipe);
}

void ChildProcess::drain_errors() {
  std::array<char, 4096> chunk;
  // Bounded, because a process that writes without end must not keep the host here.
  for (int k = 0; k < 64 && pipe_[kErr] >= 0; ++k) {
    const ssize_t n = ::read(pipe_[kErr], chunk.data(), chunk.size());
    if (n < 0 && errno == EINTR) continue;
    if (n == 0) close_pipe(kErr);
    if (n <= 0) return;
    errors_.append(chunk.data(), static_cast<std::size_t>(n));
    if (errors_.size() > kErrorTail) {
      errors_.erase(0, errors_.size() - kErrorTail);
      errors_cut_ = true;
    }
  }
}

void ChildProcess::fail(SubjectDied::Kind kind, const std::string& what) {
  static constexpr std::array kCounts{&Receipt::crashes, &Receipt::over_time, &Receipt::over_memory,
                                      &Receipt::broke_protocol};
  ++(receipt_.*kCounts[static_cast<std::size_t>(kind)]);
  epitaph_ = what;
  kill_and_reap();
  kind_ = kind;
  if (!errors_.empty()) {
    std::string_view tail(errors_);
    std::string lines;
    while (!tail.empty()) {
      const std::string_view one = tail.substr(0, tail.find('\n'));
      tail.remove_prefix(std::min(tail.size(), one.size() + 1));
      if (!one.empty()) lines += (lines.empty() ? "" : " | ") + protocol::printable(one, kErrorTail);
    }
    epitaph_ += fmt::format("; its standard error{}: {}", errors_cut_ ? " ends in" : "", lines);
  }
  throw SubjectDied(kind_, epitaph_);
}

// Standard output or input is closed: the process is ending, or no longer reads.
void ChildProcess::ended() {
  if (!wait_for_end(Clock::now() + kGrace))
    fail(SubjectDied::Kind::kProtocol, "closed its standard input or output before its answer was complete");
  kill_and_reap();
  const bool shell_says =
      WIFEXITED(*status_) && (WEXITSTATUS(*status_) == 126 || WEXITSTATUS(*status_) == 127);
  not_started_ = not_started_ || (shell_says && !answered_);
  fail(SubjectDied::Kind::kCrash,
       how_it_ended(*status_) + (WIFEXITED(*status_) ? " before its answer was complete" : ""));
}

void ChildProcess::watch_limits() {
  if (interrupted() != 0) {
    epitaph_ = "interrupted";
    kill_and_reap();
    throw Interrupted();
  }
  const auto now = Clock::now();
  if (now >= deadline_)
    fail(SubjectDied::Kind::kTimeout, fmt::format("no complete answer within {} s", limits_.seconds));
  if (now < next_look_) return;
  const std::vector<pid_t> all = descendants(keeper_);
  const Held held = held_bytes(all, limits_.memory_bytes());
  Receipt seen;
  seen.most_at_once = static_cast<std::int64_t>(all.size());
  seen.peak_bytes = static_cast<std::int64_t>(std::max(held.bytes, held.most));
  seen.peak_shared = static_cast<std::int64_t>(held.shared);
  add(receipt_, seen);
  // With thousands of processes a look takes long; at most a tenth of the time is spent on looking.
  const auto after = Clock::now();
  next_look_ = after + std::max<Clock::duration>(kTick, 9 * (after - now));
  if (held.bytes > limits_.memory_bytes())
    fail(SubjectDied::Kind::kMemory,
         fmt::format("took {} MiB of memory; {} MiB are allowed", held.bytes >> 20, limits_.memory_mib));
  if (static_cast<std::int64_t>(all.size()) > limits_.processes)
    fail(SubjectDied::Kind::kMemory,
         fmt::format("has started {} processes; {} are allowed", all.size(), limits_.processes));
}

void ChildProcess::wait_for(Pipe pipe, short events) {
  watch_limits();
  std::array<pollfd, 2> fds{{{pipe_[pipe], events, 0}, {pipe_[kErr], POLLIN, 0}}};
  const int ready = ::poll(fds.data(), fds.size(), static_cast<int>(kTick.count()));
  if (ready < 0 && errno != EINTR) refuse("cannot wait for the process");
  if (ready > 0 && fds[1].revents != 0) drain_errors();
}

void ChildProcess::start_clock() {
  deadline_ = Clock::now() +
              std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limits_.seconds));
}

void ChildProcess::ask(std::string_view request) {
  check_alive();
  start_clock();
  looked_ = false;
  if (answered_) refuse_more_output();  // before that, what it says is its first answer
  while (!request.empty()) {
    const ssize_t n = write_quietly(pipe_[kIn], request);
    if (n > 0) {
      request.remove_prefix(static_cast<std::size_t>(n));
      watch_limits();
    } else if (n < 0 && errno == EPIPE) {
      // A process that answered before it was asked, and ended, is judged by its answer.
      pollfd said{pipe_[kOut], POLLIN, 0};
      if (!answered_ && ::poll(&said, 1, 0) == 1 && (said.revents & POLLIN) != 0) return;
      ended();
    } else if (n < 0 && errno != EAGAIN && errno != EINTR) {
      refuse("cannot write to the process");
    } else {
      wait_for(kIn, POLLOUT);
    }
  }
}

// Between two answers nothing may lie in the pipe.
void ChildProcess::refuse_more_output() {
  char more = 0;
  if (buffer_.size() > taken_ || ::read(pipe_[kOut], &more, 1) == 1)
    fail(SubjectDied::Kind::kProtocol, "wrote more on its standard output than it announced");
}

void ChildProcess::read(std::span<std::byte> to) {
  check_alive();
  const std::size_t buffered = std::min(to.size(), buffer_.size() - taken_);
  if (buffered > 0) std::memcpy(to.data(), buffer_.data() + taken_, buffered);
  taken_ += buffered;
  to = to.subspan(buffered);
  while (!to.empty()) to = to.subspan(read_some(to));
}

std::string ChildProcess::line(std::size_t longest) {
  check_alive();
  for (std::size_t looked = 0;;) {
    const std::string_view left = std::string_view(buffer_).substr(taken_);
    const std::size_t end = left.find('\n', looked);
    if (std::min(end, left.size()) > longest)
      throw protocol::Error(fmt::format("it wrote more than {} bytes without a line end: \"{}\"", longest,
                                        protocol::printable(left, 80)));
    if (end != std::string_view::npos) {
      if (!std::exchange(looked_, true)) next_look_ = {};  // one look at least, however quick the answer came
      watch_limits();
      std::string result(left.substr(0, end));
      taken_ += end + 1;
      answered_ = true;
      return result;
    }
    looked = left.size();
    buffer_.erase(0, taken_);
    taken_ = 0;
    std::array<char, 65536> chunk;
    buffer_.append(chunk.data(), read_some(std::as_writable_bytes(std::span(chunk))));
  }
}

// Reads what lies in the pipe, at most so much, and returns how much it was; or waits a little.
std::size_t ChildProcess::read_some(std::span<std::byte> to) {
  const ssize_t n = ::read(pipe_[kOut], to.data(), to.size());
  if (n > 0) {
    watch_limits();
    return static_cast<std::size_t>(n);
  }
  if (n == 0) ended();
  if (errno != EAGAIN && errno != EINTR) refuse("cannot read from the process");
  wait_for(kOut, POLLIN);
  return 0;
}

void ChildProcess::finish(int exit_status) {
  check_alive();
  close_pipe(kIn);
  start_clock();
  for (;;) {
    refuse_more_output();
    if (wait_for_end(Clock::now() + kTick)) break;
    watch_limits();
    drain_errors();
  }
  refuse_more_output();
  kill_and_reap();
  const bool orderly =
      WIFEXITED(*status_) &&
      (exit_status == kAnyStatus ? WEXITSTATUS(*status_) <= 128 : WEXITSTATUS(*status_) == exit_status);
  if (!orderly) fail(SubjectDied::Kind::kCrash, how_it_ended(*status_));
}

}  // namespace limitcheck::verify
