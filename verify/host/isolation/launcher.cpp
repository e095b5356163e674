// SPDX-License-Identifier: MIT
// What starts keepers: a copy of this program from its first moments.
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <mutex>
#include <string>
#include <vector>

#include "verify/host/isolation/keeper.h"

namespace limitcheck::verify {
namespace {

constexpr std::size_t kLongest = 1 << 16;  // a message of a socket

struct Answer {
  pid_t keeper;
  int error;
};

// A message with room for descriptors.
struct Message {
  iovec text;
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(KeeperPipes))> room{};
  msghdr header{};

  Message(char* data, std::size_t size) : text{data, size} {
    header.msg_iov = &text;
    header.msg_iovlen = 1;
    header.msg_control = room.data();
    header.msg_controllen = room.size();
  }
};

// One order after another: how it is contained, then the words of the command, each with its '\0'.
[[noreturn]] void launch(int orders) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE}) std::signal(signal, SIG_IGN);
  const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int fd : {0, 1, 2}) dup2(nothing, fd);  // whoever reads what this program writes need not wait
  std::vector<char> bytes(kLongest);
  for (;;) {
    Message order(bytes.data(), bytes.size());
    const ssize_t n = recvmsg(orders, &order.header, MSG_CMSG_CLOEXEC);
    if (n < 0 && errno == EINTR) continue;
    const cmsghdr* const sent = CMSG_FIRSTHDR(&order.header);
    if (n <= 1 || sent == nullptr || sent->cmsg_len != CMSG_LEN(sizeof(KeeperPipes))) _exit(0);
    KeeperPipes pipes;
    std::memcpy(&pipes, CMSG_DATA(sent), sizeof pipes);
    std::vector<char*> argv;
    for (char* word = bytes.data() + 1; word < bytes.data() + n; word += std::strlen(word) + 1)
      argv.push_back(word);
    argv.push_back(nullptr);
    Answer answer{clone_keeper(static_cast<Containment>(bytes[0]), argv.data(), pipes, true), errno};
    for (const int fd : pipes.end) close(fd);
    if (send(orders, &answer, sizeof answer, MSG_NOSIGNAL) != sizeof answer) _exit(0);
  }
}

std::mutex asking;
bool wanted = false;
pid_t asked_by = -1;  // who has started the launcher: a process that was forked since needs one of its own
int launcher = -1;

void start() {
  if (launcher >= 0) close(launcher);
  launcher = -1;
  asked_by = getpid();
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) return;
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    launch(ends[1]);
  }
  close(ends[1]);
  if (child > 0)
    launcher = ends[0];
  else
    close(ends[0]);
}

// Whether the launcher has answered.
bool ask(Containment containment, char* const* argv, const KeeperPipes& pipes, Answer& answer) {
  std::string order(1, static_cast<char>(containment));
  for (; *argv != nullptr; ++argv) order.append(*argv).push_back('\0');
  if (order.size() > kLongest) return false;
  Message message(order.data(), order.size());
  cmsghdr* const sent = CMSG_FIRSTHDR(&message.header);
  *sent = {CMSG_LEN(sizeof(KeeperPipes)), SOL_SOCKET, SCM_RIGHTS};
  std::memcpy(CMSG_DATA(sent), &pipes, sizeof pipes);
  while (sendmsg(launcher, &message.header, MSG_NOSIGNAL) < 0)
    if (errno != EINTR) return false;
  for (ssize_t n = 0; (n = recv(launcher, &answer, sizeof answer, 0)) != sizeof answer;)
    if (n >= 0 || errno != EINTR) return false;
  return true;
}

}  // namespace

void use_launcher() {
#if !defined(__SANITIZE_THREAD__)  // knows of no process that it has not forked itself
  const std::scoped_lock lock(asking);
  wanted = true;
  if (asked_by != getpid()) start();
#endif
}

pid_t start_keeper(Containment containment, char* const* argv, const KeeperPipes& pipes) {
  const std::scoped_lock lock(asking);
  if (wanted && asked_by != getpid()) start();
  if (Answer answer{}; launcher >= 0 && ask(containment, argv, pipes, answer)) {
    errno = answer.error;
    return answer.keeper;
  }
  return clone_keeper(containment, argv, pipes, false);
}

}  // namespace limitcheck::verify
