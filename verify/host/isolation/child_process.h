// SPDX-License-Identifier: MIT
// A process that answers on its standard output, held to a time and a memory limit.
#pragma once

#include <sys/types.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "verify/host/isolation/keeper.h"
#include "verify/host/isolation/protocol.h"
#include "verify/subject/receipt.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::verify {

struct ProcessLimits {
  double seconds = 60;             // for each answer; the child's own time and its waiting count alike
  std::int64_t memory_mib = 4096;  // of the child and its children together
  std::int64_t processes = 1000;   // of the child's children together
  bool namespaces = true;          // false: the keeper is a subreaper, though the system allow namespaces
  std::uint64_t memory_bytes() const { return static_cast<std::uint64_t>(memory_mib) << 20; }
};

/// Memory is watched every 20 ms and not limited by the kernel: RLIMIT_AS and RLIMIT_DATA count what is
/// reserved, and interpreters, sanitizers and threads reserve far more than they use. So a process can be
/// beyond its limit for that long; what one machine can fill in 20 ms is some tens of MiB.
///
/// A child process under a keeper (keeper.h); its standard input, output and error are pipes. When it has
/// ended, or any failure, of whatever kind, has ended it, whatever it had started has ended too; then every
/// further call throws the same SubjectDied again. An interrupt (interrupt.h) ends it likewise, with
/// Interrupted. If this process ends, however it does, the child and all it has started end (so the thread
/// that made it must not end before). Needs Linux: prctl, /proc.
class ChildProcess : public protocol::Source {
 public:
  /// Throws HostLacks if the system cannot start another process, as all others do if it does not let them go
  /// on. A program that does not exist is found out with the first answer.
  ///   receipt   counts what it takes, if anybody asks; outlives it
  ChildProcess(const std::vector<std::string>& command, const ProcessLimits& limits,
               Receipt* receipt = nullptr);
  ~ChildProcess() override { kill_and_reap(); }

  /// Begins an exchange: sends a request; from now on the answer has `limits.seconds`.
  void ask(std::string_view request);
  void read(std::span<std::byte> to) override;
  std::string line(std::size_t longest) override;

  /// Nothing more is asked: closes the pipes and waits for an orderly end. Throws SubjectDied if it does not
  /// end in time, ends by a signal, or with another exit status than this. kAnyStatus: that of a program, in
  /// which only what a shell says of a command killed by a signal (more than 128) is a fault.
  static constexpr int kAnyStatus = -1;
  void finish(int exit_status = kAnyStatus);

  /// Kills all and throws SubjectDied: `what`, then the tail of what the child wrote on standard error.
  [[noreturn]] void fail(SubjectDied::Kind kind, const std::string& what);

  bool alive() const { return keeper_ > 0; }
  /// It could not be started: there is no such program, or a shell said so (exit status 126 or 127) before
  /// anything was answered.
  bool not_started() const { return not_started_; }
  /// How it is held.
  Containment containment() const { return containment_; }

 private:
  using Clock = std::chrono::steady_clock;
  using enum KeeperPipes::Pipe;
  using Pipe = KeeperPipes::Pipe;
  static constexpr std::array kPipes{kIn, kOut, kErr, kLifeline, kNews};

  /// Waits until the pipe is ready, at most `kTick`; keeps reading standard error; checks the limits.
  void wait_for(Pipe pipe, short events);
  void watch_limits();
  void start_clock();
  std::size_t read_some(std::span<std::byte> to);
  void refuse_more_output();
  void drain_errors();
  void take(const News& news);
  bool wait_for_end(Clock::time_point until);
  void close_pipe(Pipe pipe);
  void kill_and_reap();
  [[noreturn]] void ended();
  void check_alive() const {
    if (!alive()) throw SubjectDied(kind_, epitaph_);
  }

  ProcessLimits limits_;
  Receipt unread_, &receipt_;
  Containment containment_ = Containment::kNamespace;
  pid_t keeper_ = -1;
  std::array<int, 5> pipe_{-1, -1, -1, -1, -1};
  std::optional<int> status_;  // of the child, once it has ended: as waitpid has it
  Clock::time_point deadline_, next_look_;
  std::string buffer_;  // read from standard output and not yet taken
  std::size_t taken_ = 0;
  std::string errors_;  // the tail of standard error
  bool errors_cut_ = false;
  std::string epitaph_;
  SubjectDied::Kind kind_ = SubjectDied::Kind::kCrash;
  bool not_started_ = false, answered_ = false, looked_ = false;
};

}  // namespace limitcheck::verify
