// SPDX-License-Identifier: MIT
// The host's side of a keeper. The system copies the tables of all pages of a process that it forks, and this program
// grows large: so the new process shares its memory, and the thread waits, until limitcheck-keeper runs in its place.
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/close_range.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <string>
#include <string_view>

#include "verify/host/isolation/keeper.h"

namespace limitcheck::verify {
namespace {

std::string& keeper_program() {
  static std::string program;
  return program;
}

struct Start {
  Containment containment;
  const KeeperPipes& pipes;
  char* const* argv;
  uid_t user;
  gid_t group;
  bool new_user = false;
  volatile int error = 0;
};

bool write_to(const char* file, std::string_view text) {
  const int fd = open(file, O_WRONLY | O_CLOEXEC);
  const bool written = fd >= 0 && write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (fd >= 0) close(fd);
  return written;
}

// In the new user namespace, user and group keep their numbers.
bool keep_identity(const Start& start) {
  const auto keep = [](const char* file, unsigned number) {
    std::array<char, 64> text{};  // fmt takes no memory for numbers
    const auto end = fmt::format_to_n(text.data(), text.size(), "{0} {0} 1", number).out;
    return write_to(file, {text.data(), static_cast<std::size_t>(end - text.data())});
  };
  return write_to("/proc/self/setgroups", "deny") && keep("/proc/self/uid_map", start.user) &&
         keep("/proc/self/gid_map", start.group);
}

// A /proc with the numbers of this namespace: interpreters and debuggers look for themselves there.
bool mount_proc() {
  return mount("", "/", nullptr, MS_PRIVATE | MS_REC, nullptr) == 0 &&
         mount("proc", "/proc", "proc", MS_NOSUID | MS_NODEV | MS_NOEXEC, nullptr) == 0;
}

// The new process: nothing but async-signal-safe calls. What a namespace needs is done here, where it has the right to.
int become_keeper(void* given) {
  auto& start = *static_cast<Start*>(given);
  // It keeps no other descriptors: the lifeline of another child, if open here, would keep that child alive.
  close_range(3, ~0U, CLOSE_RANGE_CLOEXEC);
  for (const int fd : start.pipes.end) fcntl(fd, F_SETFD, 0);
  if (start.containment == Containment::kSubreaper ||
      ((!start.new_user || keep_identity(start)) && mount_proc()))
    execv(start.argv[0], start.argv);
  start.error = errno;
  _exit(127);
}

}  // namespace

void use_keeper(const std::string& program) {
  keeper_program() = program;
}

pid_t start_keeper(Containment containment, const std::vector<std::string>& command,
                   const KeeperPipes& pipes) {
  std::vector<std::string> words{keeper_program(),
                                 containment == Containment::kNamespace ? "namespace" : "subreaper"};
  for (const int fd : pipes.end) words.push_back(std::to_string(fd));
  words.insert(words.end(), command.begin(), command.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  Start start{containment, pipes, argv.data(), geteuid(), getegid()};
  sigset_t all, before;  // a handler of this program must not run in the other process
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  pid_t keeper = -1;
#if defined(__SANITIZE_THREAD__)  // knows of no process that it has not forked itself
  errno = ENOSYS;
  if (containment == Containment::kSubreaper && (keeper = fork()) == 0) become_keeper(&start);
#else
  alignas(64) std::array<char, 65536> stack;
  const auto begin = [&](int namespaces) {
    return clone(become_keeper, stack.data() + stack.size(), CLONE_VM | CLONE_VFORK | SIGCHLD | namespaces,
                 &start);
  };
  constexpr int kNamespaces = CLONE_NEWPID | CLONE_NEWNS;
  keeper = begin(containment == Containment::kNamespace ? kNamespaces : 0);
  if (keeper < 0 && errno == EPERM && containment == Containment::kNamespace) {
    start.new_user = true;
    keeper = begin(kNamespaces | CLONE_NEWUSER);
  }
#endif
  const int error = keeper < 0 ? errno : start.error;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (keeper > 0 && error != 0) waitpid(keeper, nullptr, 0);
  errno = error;
  return error == 0 ? keeper : -1;
}

}  // namespace limitcheck::verify
