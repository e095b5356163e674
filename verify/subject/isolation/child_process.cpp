// SPDX-License-Identifier: MIT
#include "verify/subject/isolation/child_process.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <thread>

#include "verify/interrupt/interrupt.h"

namespace limitcheck::verify {
namespace {

using namespace std::chrono_literals;
constexpr auto kTick = 20ms;  // between two looks at clock and memory
constexpr auto kGrace = 2s;   // to end in after the pipes are closed
constexpr std::size_t kErrorTail = 2000;

[[noreturn]] void refuse(const char* what) {
  throw SubjectError(LC_FAILED, fmt::format("{}: {}", what, std::strerror(errno)));
}

// Between fork and exec of a program with threads: nothing but async-signal-safe calls.
[[noreturn]] void become(char* const* argv, const std::array<std::array<int, 2>, 3>& pipes, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(126);  // it ended before the line above
  if (dup2(pipes[0][0], STDIN_FILENO) < 0 || dup2(pipes[1][1], STDOUT_FILENO) < 0 ||
      dup2(pipes[2][1], STDERR_FILENO) < 0)
    _exit(126);
  close_range(3, ~0U, 0);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  signal(SIGPIPE, SIG_DFL);
  execv(argv[0], argv);
  _exit(127);
}

// Resident pages of a process and of all it has started.
std::uint64_t resident_bytes(pid_t pid, int generation = 0) {
  std::uint64_t size = 0, resident = 0;
  std::ifstream(fmt::format("/proc/{}/statm", pid)) >> size >> resident;
  std::uint64_t bytes = resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", pid));
  for (pid_t child = 0; generation < 8 && children >> child;) bytes += resident_bytes(child, generation + 1);
  return bytes;
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
  return fmt::format("ended with exit status {} before its answer was complete", WEXITSTATUS(status));
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const ProcessLimits& limits)
    : limits_(limits) {
  std::vector<char*> argv;
  for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);

  std::array<std::array<int, 2>, 3> pipes{{{-1, -1}, {-1, -1}, {-1, -1}}};
  const auto close_all = [&pipes] {
    for (const auto& ends : pipes)
      for (const int fd : ends)
        if (fd >= 0) ::close(fd);
  };
  for (auto& ends : pipes)
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
      close_all();
      refuse("cannot make a pipe");
    }
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) become(argv.data(), pipes, parent);
  if (pid_ < 0) {
    close_all();
    refuse("cannot start a process");
  }
  setpgid(pid_, pid_);  // in both, so that it holds from here on
  pipe_ = {pipes[0][1], pipes[1][0], pipes[2][0]};
  for (const int fd : {pipes[0][0], pipes[1][1], pipes[2][1]}) ::close(fd);
  for (const int fd : pipe_) fcntl(fd, F_SETFL, O_NONBLOCK);
  start_clock();
}

ChildProcess::~ChildProcess() {
  kill_and_reap();
}

void ChildProcess::close_pipe(Pipe pipe) {
  if (pipe_[pipe] >= 0) ::close(pipe_[pipe]);
  pipe_[pipe] = -1;
}

void ChildProcess::kill_and_reap() {
  if (pid_ > 0) {
    kill(-pid_, SIGKILL);  // before it is reaped: until then the number is its own
    while (waitpid(pid_, &status_, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    drain_errors();
  }
  for (const Pipe pipe : {kIn, kOut, kErr}) close_pipe(pipe);
}

void ChildProcess::drain_errors() {
  std::array<char, 4096> chunk;
  // Bounded: what writes without end must not keep the host here.
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

void ChildProcess::check_alive() const {
  if (pid_ < 0) throw SubjectDied(kind_, epitaph_);
}

void ChildProcess::fail(SubjectDied::Kind kind, const std::string& what) {
  kill_and_reap();
  kind_ = kind;
  epitaph_ = what;
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

// Standard output or input is closed: the process is ending, or has lost interest.
void ChildProcess::ended() {
  const auto patience = Clock::now() + kGrace;
  siginfo_t info{};
  for (;;) {
    // Not reaped yet: its process group must be killed first.
    info.si_pid = 0;
    if (waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
        info.si_pid == pid_)
      break;
    if (Clock::now() > patience)
      fail(SubjectDied::Kind::kProtocol,
           "closed its standard input or output before its answer was complete");
    drain_errors();
    std::this_thread::sleep_for(1ms);
  }
  kill_and_reap();
  not_started_ = WIFEXITED(status_) && (WEXITSTATUS(status_) == 126 || WEXITSTATUS(status_) == 127);
  fail(SubjectDied::Kind::kCrash, how_it_ended(status_));
}

void ChildProcess::watch_limits() {
  if (interrupted() != 0) {
    kill_and_reap();
    epitaph_ = "interrupted";
    throw Interrupted();
  }
  const auto now = Clock::now();
  if (now >= deadline_)
    fail(SubjectDied::Kind::kTimeout, fmt::format("no complete answer within {} s", limits_.seconds));
  if (now < next_look_) return;
  next_look_ = now + kTick;
  const std::uint64_t bytes = resident_bytes(pid_);
  if (bytes > limits_.memory_bytes())
    fail(SubjectDied::Kind::kMemory,
         fmt::format("took {} MiB of memory; {} MiB are allowed", bytes >> 20, limits_.memory_mib));
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
  refuse_more_output();
  while (!request.empty()) {
    const ssize_t n = write_quietly(pipe_[kIn], request);
    if (n > 0) {
      request.remove_prefix(static_cast<std::size_t>(n));
      watch_limits();
    } else if (n < 0 && errno == EPIPE) {
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
  while (!to.empty()) {
    const ssize_t n = ::read(pipe_[kOut], to.data(), to.size());
    if (n > 0) {
      to = to.subspan(static_cast<std::size_t>(n));
      watch_limits();
    } else if (n == 0) {
      ended();
    } else if (errno != EAGAIN && errno != EINTR) {
      refuse("cannot read from the process");
    } else {
      wait_for(kOut, POLLIN);
    }
  }
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
      next_look_ = {};  // one look at least, however quick the answer came
      watch_limits();
      std::string result(left.substr(0, end));
      taken_ += end + 1;
      return result;
    }
    looked = left.size();
    buffer_.erase(0, taken_);
    taken_ = 0;
    fill_buffer();
  }
}

// Appends what lies in the pipe, if anything, to the buffer, or waits a little.
void ChildProcess::fill_buffer() {
  constexpr std::size_t kChunk = 65536;
  const std::size_t old = buffer_.size();
  buffer_.resize(old + kChunk);
  const ssize_t n = ::read(pipe_[kOut], buffer_.data() + old, kChunk);
  const int error = errno;
  buffer_.resize(old + static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
  if (n > 0) {
    watch_limits();
  } else if (n == 0) {
    ended();
  } else if (error != EAGAIN && error != EINTR) {
    refuse("cannot read from the process");
  } else {
    wait_for(kOut, POLLIN);
  }
}

void ChildProcess::finish() {
  check_alive();
  close_pipe(kIn);
  start_clock();
  for (;;) {
    refuse_more_output();
    siginfo_t info{};
    if (waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
        info.si_pid == pid_)
      break;
    watch_limits();
    drain_errors();
    std::this_thread::sleep_for(1ms);
  }
  kill_and_reap();
  if (WIFSIGNALED(status_)) fail(SubjectDied::Kind::kCrash, how_it_ended(status_));
}

}  // namespace limitcheck::verify
