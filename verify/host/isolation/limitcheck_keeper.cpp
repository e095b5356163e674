// SPDX-License-Identifier: MIT
// limitcheck-keeper: holds a process for limitcheck (keeper.h).
//   limitcheck-keeper namespace|subreaper IN OUT ERR LIFELINE NEWS COMMAND...
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string>
#include <string_view>

#include "verify/host/isolation/keeper.h"
#include "verify/host/isolation/process_tree.h"

namespace limitcheck::verify {
namespace {

constexpr std::array<int, 5> kIgnored{SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE};  // by the keeper
constexpr int kSweeps = 2000;                                                      // a millisecond apart

void tell(int news, News::Kind kind, int value) {
  const News message{kind, value};
  while (write(news, &message, sizeof message) < 0 && errno == EINTR) {
  }
}

[[noreturn]] void become_child(char* const* argv, const KeeperPipes& pipes) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  setpgid(0, 0);
  for (int k = 0; k < 3; ++k)
    if (dup2(pipes.end[k], k) < 0) {
      tell(pipes.end[KeeperPipes::kNews], News::kNotStarted, errno);
      _exit(126);
    }
  const rlimit no_core{1, 1};  // 1, not 0: a program that takes core dumps from a pipe would get them with 0
  setrlimit(RLIMIT_CORE, &no_core);
  for (const int signal : kIgnored) std::signal(signal, SIG_DFL);
  std::signal(SIGXFSZ, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  execv(argv[0], argv);
  tell(pipes.end[KeeperPipes::kNews], News::kNotStarted, errno);
  _exit(127);
}

// Kills its children; theirs become its own and are next.
void sweep(pid_t child) {
  for (int k = 0; k < kSweeps; ++k) {
    kill(-child, SIGKILL);
    for (const pid_t process : children_of(getpid())) kill(process, SIGKILL);
    for (pid_t gone = 0; (gone = waitpid(-1, nullptr, WNOHANG)) != 0;)
      if (gone < 0 && errno == ECHILD) return;
    poll(nullptr, 0, 1);
  }
}

int keep(bool in_namespace, char* const* argv, const KeeperPipes& pipes) {
  // Without a namespace the keeper must live to kill its children: there only the lifeline ends it.
  if (in_namespace) prctl(PR_SET_PDEATHSIG, SIGKILL);
  setsid();
  for (const int signal : kIgnored) std::signal(signal, SIG_IGN);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  sigset_t ended;
  sigemptyset(&ended);
  sigaddset(&ended, SIGCHLD);
  sigprocmask(SIG_SETMASK, &ended, nullptr);
  std::signal(SIGCHLD, SIG_DFL);
  const int signals = signalfd(-1, &ended, SFD_CLOEXEC | SFD_NONBLOCK);

  const pid_t child = fork();
  if (child == 0) become_child(argv, pipes);
  if (child < 0) {
    tell(pipes.end[KeeperPipes::kNews], News::kGivesUp, errno);
    return 1;
  }
  for (int k = 0; k < 3; ++k) close(pipes.end[k]);
  for (const int fd : {0, 1, 2}) close(fd);

  for (bool host_lives = true; host_lives;) {
    int status = 0;
    for (pid_t gone = 0; (gone = waitpid(-1, &status, WNOHANG)) > 0;) {
      if (gone != child) continue;
      if (!in_namespace) sweep(child);
      tell(pipes.end[KeeperPipes::kNews], News::kEnded, status);
      return 0;  // and with the first process of a namespace all others end
    }
    std::array<pollfd, 2> awaited{{{pipes.end[KeeperPipes::kLifeline], POLLIN, 0}, {signals, POLLIN, 0}}};
    poll(awaited.data(), awaited.size(), signals < 0 ? 10 : -1);
    std::array<signalfd_siginfo, 8> taken{};
    if (read(signals, taken.data(), sizeof taken) < 0 && errno != EAGAIN && errno != EINTR) return 1;
    host_lives = awaited[0].revents == 0;
  }
  if (!in_namespace) sweep(child);
  return 0;
}

}  // namespace
}  // namespace limitcheck::verify

int main(int argc, char** argv) {
  using namespace limitcheck::verify;
  KeeperPipes pipes;
  constexpr int kCommand = 2 + static_cast<int>(pipes.end.size());
  if (argc <= kCommand) {
    std::fputs("limitcheck-keeper: `limitcheck audit` starts this program\n", stderr);
    return 2;
  }
  for (std::size_t k = 0; k < pipes.end.size(); ++k) {
    pipes.end[k] = std::stoi(argv[2 + k]);
    fcntl(pipes.end[k], F_SETFD, FD_CLOEXEC);
  }
  _exit(keep(std::string_view(argv[1]) == "namespace", argv + kCommand, pipes));
}
