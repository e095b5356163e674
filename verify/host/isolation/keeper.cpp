// SPDX-License-Identifier: MIT
// All of this runs between fork and exec of a program with threads: nothing but async-signal-safe calls, and fmt for
// numbers into an array; no heap.
#include "verify/host/isolation/keeper.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>

namespace limitcheck::verify {
namespace {

constexpr std::array<int, 5> kIgnored{SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE};  // by the keeper
constexpr int kSweeps = 2000;                                                      // a millisecond apart

struct Identity {
  uid_t user;
  gid_t group;
};

void tell(int news, News::Kind kind, int value) {
  const News message{kind, value};
  while (write(news, &message, sizeof message) < 0 && errno == EINTR) {
  }
}

bool write_to(const char* file, std::string_view text) {
  const int fd = open(file, O_WRONLY | O_CLOEXEC);
  const bool written = fd >= 0 && write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (fd >= 0) close(fd);
  return written;
}

// In the new user namespace, user and group keep their numbers.
bool keep_identity(const Identity& own) {
  const auto keep = [](const char* file, unsigned number) {
    std::array<char, 64> text{};  // fmt takes no memory for numbers
    const auto end = fmt::format_to_n(text.data(), text.size(), "{0} {0} 1", number).out;
    return write_to(file, {text.data(), static_cast<std::size_t>(end - text.data())});
  };
  return write_to("/proc/self/setgroups", "deny") && keep("/proc/self/uid_map", own.user) &&
         keep("/proc/self/gid_map", own.group);
}

// A /proc with the numbers of this namespace: interpreters and debuggers look for themselves there.
bool mount_proc() {
  return mount("", "/", nullptr, MS_PRIVATE | MS_REC, nullptr) == 0 &&
         mount("proc", "/proc", "proc", MS_NOSUID | MS_NODEV | MS_NOEXEC, nullptr) == 0;
}

[[noreturn]] void become_child(char* const* argv, const KeeperPipes& pipes) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  setpgid(0, 0);
  for (int k = 0; k < 3; ++k)
    if (dup2(pipes.end[k], k) < 0) {
      tell(pipes.end[KeeperPipes::kNews], News::kNotStarted, errno);
      _exit(126);
    }
  fcntl(pipes.end[KeeperPipes::kNews], F_SETFD, FD_CLOEXEC);
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

// The number that the text begins with, or -1.
pid_t decimal(const char* text) {
  pid_t value = -1;
  for (; *text >= '0' && *text <= '9'; ++text) value = 10 * std::max(value, 0) + (*text - '0');
  return *text == '\0' || *text == ' ' ? value : -1;
}

pid_t parent_of(const char* process) {
  std::array<char, 300> file{}, stat{};
  stpcpy(stpcpy(stpcpy(file.data(), "/proc/"), process), "/stat");
  const int fd = open(file.data(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return -1;
  const ssize_t n = read(fd, stat.data(), stat.size() - 1);
  close(fd);
  // 42 (its name) S 1 ...
  const char* behind = n > 0 ? std::strrchr(stat.data(), ')') : nullptr;
  return behind != nullptr && std::strlen(behind) > 4 ? decimal(behind + 4) : -1;
}

void kill_children(pid_t self) {
  const int folder = open("/proc", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  alignas(dirent64) std::array<char, 8192> entries{};
  for (long n = 0; (n = syscall(SYS_getdents64, folder, entries.data(), entries.size())) > 0;)
    for (long at = 0; at < n;) {
      const auto* const entry = reinterpret_cast<const dirent64*>(entries.data() + at);
      at += entry->d_reclen;
      const pid_t process = decimal(entry->d_name);
      if (process > 0 && parent_of(entry->d_name) == self) kill(process, SIGKILL);
    }
  close(folder);
}

// Kills its children; theirs become its own and are next.
void sweep(pid_t child) {
  const pid_t self = getpid();
  for (int k = 0; k < kSweeps; ++k) {
    kill(-child, SIGKILL);
    kill_children(self);
    for (pid_t gone = 0; (gone = waitpid(-1, nullptr, WNOHANG)) != 0;)
      if (gone < 0 && errno == ECHILD) return;
    poll(nullptr, 0, 1);
  }
}

[[noreturn]] void end() {
  for (;;) syscall(SYS_exit_group, 0);
}

[[noreturn]] void keep(bool in_namespace, const Identity* mapped, char* const* argv, KeeperPipes pipes) {
  // Without a namespace the keeper must live to kill its children: there only the lifeline ends it.
  if (in_namespace) prctl(PR_SET_PDEATHSIG, SIGKILL);
  setsid();
  for (const int signal : kIgnored) std::signal(signal, SIG_IGN);
  // It keeps no other descriptors: the lifeline of another child, if open here, would keep that child alive.
  std::array<int, 5> own = pipes.end;
  std::sort(own.begin(), own.end());
  unsigned next = 3;
  for (const int fd : own) {
    if (fd >= 3 && static_cast<unsigned>(fd) > next) close_range(next, static_cast<unsigned>(fd) - 1, 0);
    next = std::max(next, static_cast<unsigned>(fd) + 1);
  }
  close_range(next, ~0U, 0);

  if (in_namespace && ((mapped != nullptr && !keep_identity(*mapped)) || !mount_proc())) {
    tell(pipes.end[KeeperPipes::kNews], News::kGivesUp, errno);
    end();
  }
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  sigset_t ended;
  sigemptyset(&ended);
  sigaddset(&ended, SIGCHLD);
  sigprocmask(SIG_SETMASK, &ended, nullptr);
  std::signal(SIGCHLD, SIG_DFL);
  const int signals = signalfd(-1, &ended, SFD_CLOEXEC | SFD_NONBLOCK);

  const pid_t child = static_cast<pid_t>(syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0));
  if (child == 0) become_child(argv, pipes);
  if (child < 0) {
    tell(pipes.end[KeeperPipes::kNews], News::kGivesUp, errno);
    end();
  }
  tell(pipes.end[KeeperPipes::kNews], News::kRunning, 0);
  for (int k = 0; k < 3; ++k) close(pipes.end[k]);
  for (const int fd : {0, 1, 2}) close(fd);

  for (bool host_lives = true; host_lives;) {
    int status = 0;
    for (pid_t gone = 0; (gone = waitpid(-1, &status, WNOHANG)) > 0;) {
      if (gone != child) continue;
      if (!in_namespace) sweep(child);
      tell(pipes.end[KeeperPipes::kNews], News::kEnded, status);
      end();  // and with the first process of a namespace all others end
    }
    std::array<pollfd, 2> awaited{{{pipes.end[KeeperPipes::kLifeline], POLLIN, 0}, {signals, POLLIN, 0}}};
    poll(awaited.data(), awaited.size(), signals < 0 ? 10 : -1);
    std::array<signalfd_siginfo, 8> taken{};
    if (read(signals, taken.data(), sizeof taken) < 0 && errno != EAGAIN && errno != EINTR) end();
    host_lives = awaited[0].revents == 0;
  }
  if (!in_namespace) sweep(child);
  end();
}

}  // namespace

pid_t clone_keeper(Containment containment, char* const* argv, const KeeperPipes& pipes, bool as_sibling) {
  const Identity own{geteuid(), getegid()};
  const auto clone = [&](long flags) {
    return static_cast<pid_t>(
        syscall(SYS_clone, flags | SIGCHLD | (as_sibling ? CLONE_PARENT : 0), 0, 0, 0, 0));
  };
  if (containment == Containment::kSubreaper) {
    const pid_t keeper = as_sibling ? clone(0) : fork();  // which sanitizers know of
    if (keeper == 0) keep(false, nullptr, argv, pipes);
    return keeper;
  }
#if defined(__SANITIZE_THREAD__)  // knows of no process that it has not forked itself
  errno = ENOSYS;
  return -1;
#else
  constexpr long kNamespaces = CLONE_NEWPID | CLONE_NEWNS;
  pid_t keeper = clone(kNamespaces);
  if (keeper == 0) keep(true, nullptr, argv, pipes);
  if (keeper > 0 || errno != EPERM) return keeper;
  keeper = clone(kNamespaces | CLONE_NEWUSER);
  if (keeper == 0) keep(true, &own, argv, pipes);
  return keeper;
#endif
}

}  // namespace limitcheck::verify
