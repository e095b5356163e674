// SPDX-License-Identifier: MIT
// What a library or a program may do to its process and to the system, each wrong on purpose.
#include "verify/host/isolation/test_subjects/things.h"

#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>

namespace {

volatile int* nowhere = nullptr;
volatile int zero = 0;

int overflow_the_stack(int depth) {
  volatile char page[4096];
  page[0] = static_cast<char>(depth);
  return depth == INT_MAX ? page[0] : overflow_the_stack(depth + 1) + page[0];
}

void take_memory(std::size_t mib) {
  for (std::size_t k = 0; k < mib; ++k) {
    void* const taken = mmap(nullptr, 1 << 20, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (taken != MAP_FAILED) std::memset(taken, 1, 1 << 20);
  }
}

// Shared memory that no process has resident.
void fill_memfd(std::size_t mib, bool map) {
  const int fd = memfd_create("filled", 0);
  const std::string chunk(1 << 20, 'x');
  for (std::size_t k = 0; k < mib; ++k) (void)!write(fd, chunk.data(), chunk.size());
  if (!map) return;
  (void)mmap(nullptr, 4096, PROT_READ, MAP_SHARED, fd, 0);
  close(fd);
}

// Does this in a process of its own that does not end, and goes on.
template <class Work>
void in_a_child(Work work) {
  if (fork() == 0) {
    work();
    sleep_for_ever();
  }
}

template <class Work>
void in_a_thread(Work work) {
  static Work kept = work;
  pthread_t thread{};
  pthread_create(
      &thread, nullptr,
      [](void*) -> void* {
        kept();
        return nullptr;
      },
      nullptr);
  pthread_detach(thread);
}

// Forks away from whoever looks after it.
template <class Work>
void as_a_daemon(Work work) {
  const pid_t first = fork();
  if (first == 0) {
    setsid();
    if (fork() == 0) {
      work();
      sleep_for_ever();
    }
    _exit(0);
  }
  waitpid(first, nullptr, 0);
}

void kill_all_with_my_name() {  // what a script with killall does; inside a namespace nobody else is in sight
  kill(getppid(), SIGKILL);
  sleep_for_ever();
}

}  // namespace

void sleep_for_ever() {
  for (;;) sleep(1000);
}

const std::map<std::string, void (*)()>& things() {
  static const std::map<std::string, void (*)()> all{
      {"nothing", [] {}},
      {"memfd_written", [] { fill_memfd(600, false), sleep_for_ever(); }},
      {"memfd_mapped", [] { fill_memfd(600, true), sleep_for_ever(); }},
      {"memfd_small", [] { fill_memfd(100, false); }},
      // Ends.
      {"segfault", [] { *nowhere = 1; }},
      {"abort", [] { std::abort(); }},
      {"divide", [] { zero = 100 / zero; }},
      {"illegal", [] { __builtin_trap(); }},
      {"bus",
       [] {
         const int fd = memfd_create("gone", 0);
         (void)!ftruncate(fd, 4096);
         auto* const page = static_cast<volatile char*>(mmap(nullptr, 4096, PROT_READ, MAP_SHARED, fd, 0));
         (void)!ftruncate(fd, 0);
         zero = page[0];
       }},
      {"exit0", [] { std::exit(0); }},
      {"exit3", [] { std::exit(3); }},
      {"_exit0", [] { _exit(0); }},
      {"_exit3", [] { _exit(3); }},
      {"_exit127", [] { _exit(127); }},
      {"quick_exit", [] { std::quick_exit(0); }},
      {"terminate", [] { std::terminate(); }},
      {"raise_term", [] { raise(SIGTERM); }},
      {"raise_kill", [] { raise(SIGKILL); }},
      {"raise_pipe", [] { raise(SIGPIPE); }},
      {"raise_usr1", [] { raise(SIGUSR1); }},
      {"alarm", [] { ualarm(1000, 0), sleep_for_ever(); }},
      {"cpu_limit",
       [] {
         const rlimit none{0, 0};
         setrlimit(RLIMIT_CPU, &none);
         for (volatile bool on = true; on;) {
         }
       }},
      {"stack", [] { overflow_the_stack(0); }},
      {"double_free",
       [] {
         void* volatile p = std::malloc(100);
         std::free(p);
         std::free(p);  // NOLINT
       }},
      {"heap",
       [] {
         auto* const p = static_cast<char*>(std::malloc(24));
         std::memset(p - 16, 0x41, 64);
         std::free(p);
         for (int k = 0; k < 1000; ++k) std::free(std::malloc(24));
       }},
      {"kill_group", [] { kill(0, SIGKILL); }},
      {"throw", [] { throw std::runtime_error("out of luck"); }},
      {"throw_int", [] { throw 42; }},
      {"crash_in_a_thread", [] { in_a_thread([] { *nowhere = 1; }), sleep_for_ever(); }},
      {"exit_in_a_thread", [] { in_a_thread([] { _exit(0); }), sleep_for_ever(); }},
      {"end_of_thread", [] { pthread_exit(nullptr); }},
      // Hangs.
      {"sleep", [] { sleep_for_ever(); }},
      {"spin",
       [] {
         for (volatile bool on = true; on;) {
         }
       }},
      {"stop", [] { raise(SIGSTOP); }},
      {"stop_group", [] { kill(0, SIGSTOP); }},
      {"leave_group", [] { setpgid(0, getpgid(getppid())), sleep_for_ever(); }},
      {"own_session", [] { setsid(), sleep_for_ever(); }},
      {"ignore_signals",
       [] {
         for (int s = 1; s < 64; ++s) std::signal(s, SIG_IGN);
         sleep_for_ever();
       }},
      {"block_signals",
       [] {
         sigset_t all_signals;
         sigfillset(&all_signals);
         sigprocmask(SIG_SETMASK, &all_signals, nullptr);
         sleep_for_ever();
       }},
      {"deadlock",
       [] {
         static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
         pthread_mutex_lock(&mutex);
         pthread_mutex_lock(&mutex);
       }},
      {"wait_for_input",
       [] {
         int ends[2];
         (void)!pipe(ends);
         (void)!read(ends[0], ends, 1);
       }},
      {"survive_parent", [] { prctl(PR_SET_PDEATHSIG, 0), sleep_for_ever(); }},
      {"flood_errors",
       [] {
         for (;;) (void)!write(STDERR_FILENO, "nonsense nonsense nonsense\n", 27);
       }},
      {"kill_parent", [] { kill_all_with_my_name(); }},
      {"stop_parent", [] { kill(getppid(), SIGSTOP), sleep_for_ever(); }},
      {"terminate_parent", [] { kill(getppid(), SIGTERM), sleep_for_ever(); }},
      // Takes too much.
      {"memory", [] { take_memory(600), sleep_for_ever(); }},
      {"memory_in_a_child", [] { in_a_child([] { take_memory(600); }), sleep_for_ever(); }},
      {"memory_off_a_thread",
       [] { in_a_thread([] { in_a_child([] { take_memory(600); }); }), sleep_for_ever(); }},
      {"memory_in_a_daemon", [] { as_a_daemon([] { take_memory(600); }), sleep_for_ever(); }},
      {"memory_in_five",
       [] {
         for (int k = 0; k < 5; ++k) in_a_child([] { take_memory(120); });
         sleep_for_ever();
       }},
      {"many_processes",
       [] {
         for (int k = 0; k < 60; ++k) in_a_child([] {});
         sleep_for_ever();
       }},
      // Leaves something behind, and is right otherwise.
      {"child", [] { in_a_child([] {}); }},
      {"deaf_child", [] { in_a_child([] { std::signal(SIGTERM, SIG_IGN), std::signal(SIGHUP, SIG_IGN); }); }},
      {"session_child", [] { in_a_child([] { setsid(); }); }},
      {"daemon", [] { as_a_daemon([] {}); }},
      {"stopped_child", [] { in_a_child([] { raise(SIGSTOP); }); }},
      {"zombie",
       [] {
         if (fork() == 0) _exit(0);
       }},
      {"spinning_thread",
       [] {
         in_a_thread([] {
           for (volatile bool on = true; on;) usleep(1000);
         });
       }},
      {"print", [] { std::printf("{\"status\": \"ok\"}\n"), std::fflush(stdout); }},
      {"write_to_1", [] { (void)!write(STDOUT_FILENO, "not an answer\n", 14); }},
      {"close_standard", [] { close(0), close(1); }},
      {"other_folder", [] { (void)!chdir("/"); }},
      {"no_permissions", [] { umask(0777); }},
      {"lower_limits",
       [] {
         const rlimit few{20, 20};
         setrlimit(RLIMIT_NOFILE, &few);
       }},
      {"leak", [] { take_memory(20); }},
      {"shared_children",  // which share one and the same memory: not 20 times as much
       [] {
         take_memory(60);
         for (int k = 0; k < 20; ++k) in_a_child([] {});
         usleep(100000);
       }},
      {"signal_handlers",
       [] {
         for (int s = 1; s < 32; ++s) std::signal(s, [](int) {});
       }},
      {"renamed", [] { prctl(PR_SET_NAME, ") S 1 2 (x"); }},
      // Breaks the line to the host.
      {"close_all", [] { close_range(3, ~0U, 0); }},
      {"write_to_all",
       [] {
         for (int fd = 3; fd < 64; ++fd)
           (void)!::send(fd, "x", 1, MSG_DONTWAIT), (void)!write(fd, "junk\n", 5);
       }},
  };
  return all;
}
