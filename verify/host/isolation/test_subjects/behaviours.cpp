// SPDX-License-Identifier: MIT
// A library that behaves as the C example does until it is told otherwise: behaviour=THING@PLACE. Everything
// here is wrong on purpose. PLACE: capabilities, create, tessellate, release, destroy, unload; "answer"
// spoils what was tessellated well.
#include <fcntl.h>
#include <limitcheck/subject.h>
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
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

extern "C" const lc_subject* good_subject_get(std::uint32_t abi);  // good_subject.c, its entry renamed

namespace {

const lc_subject& good() {
  return *good_subject_get(LC_SUBJECT_ABI);
}

volatile int* nowhere = nullptr;
volatile int zero = 0;

[[noreturn]] void sleep_for_ever() {
  for (;;) sleep(1000);
}

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

// Each of these is one way to behave in a function.
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

// Spoils a good answer.
using Spoil = void (*)(const lc_mesh&, lc_tessellation&);
double* positions(const lc_tessellation& t) {
  return static_cast<double*>(t.positions);
}
const std::map<std::string, Spoil>& spoils() {
  static const std::map<std::string, Spoil> all{
      {"huge_vertex_count",
       [](const lc_mesh&, lc_tessellation& t) { t.vertex_count = std::int64_t{1} << 60; }},
      {"huge_triangle_count", [](const lc_mesh&, lc_tessellation& t) { t.triangle_count = INT64_MAX; }},
      {"negative_vertices", [](const lc_mesh&, lc_tessellation& t) { t.vertex_count = -1; }},
      {"negative_triangles", [](const lc_mesh&, lc_tessellation& t) { t.triangle_count = INT64_MIN; }},
      {"one_vertex_more", [](const lc_mesh&, lc_tessellation& t) { ++t.vertex_count; }},
      {"no_positions", [](const lc_mesh&, lc_tessellation& t) { t.positions = nullptr; }},
      {"no_triangles", [](const lc_mesh&, lc_tessellation& t) { t.triangles = nullptr; }},
      {"no_provenance", [](const lc_mesh&, lc_tessellation& t) { t.provenance = nullptr; }},
      {"no_faces", [](const lc_mesh&, lc_tessellation& t) { t.triangle_face = nullptr; }},
      {"heap_positions", [](const lc_mesh&, lc_tessellation& t) { t.positions = std::malloc(1 << 16); }},
      {"stack_positions",
       [](const lc_mesh&, lc_tessellation& t) {
         double local[4] = {};
         void* volatile place = local;
         t.positions = place;
       }},
      {"wild_positions",
       [](const lc_mesh&, lc_tessellation& t) { t.positions = reinterpret_cast<void*>(0xDEADBEEF000); }},
      {"misaligned",
       [](const lc_mesh&, lc_tessellation& t) { t.positions = static_cast<char*>(t.positions) + 1; }},
      {"same_array", [](const lc_mesh&, lc_tessellation& t) { t.normals = t.positions; }},
      {"write_8_behind", [](const lc_mesh&, lc_tessellation& t) { positions(t)[3 * t.vertex_count] = 1; }},
      {"write_1000_behind",
       [](const lc_mesh&, lc_tessellation& t) { positions(t)[3 * t.vertex_count + 124] = 1; }},
      {"write_1100_behind",
       [](const lc_mesh&, lc_tessellation& t) { positions(t)[3 * t.vertex_count + 137] = 1; }},
      {"write_100000_behind",
       [](const lc_mesh&, lc_tessellation& t) { positions(t)[3 * t.vertex_count + 12500] = 1; }},
      {"write_8_before", [](const lc_mesh&, lc_tessellation& t) { positions(t)[-1] = 1; }},
      {"write_9000_before", [](const lc_mesh&, lc_tessellation& t) { positions(t)[-1125] = 1; }},
      {"write_a5_behind",  // a pattern that was guard bytes once
       [](const lc_mesh&, lc_tessellation& t) { std::memset(positions(t) + 3 * t.vertex_count, 0xA5, 64); }},
      {"read_behind",
       [](const lc_mesh&, lc_tessellation& t) { zero = positions(t)[3 * t.vertex_count + 4000] > 0; }},
      {"erase_all",
       [](const lc_mesh&, lc_tessellation& t) { std::memset(t.positions, 0, std::size_t{1} << 40); }},
      {"unmap",
       [](const lc_mesh&, lc_tessellation& t) {
         auto* const page = reinterpret_cast<void*>(reinterpret_cast<std::uintptr_t>(t.positions) & ~4095ULL);
         munmap(page, 4096);
       }},
      {"free_it",
       [](const lc_mesh&, lc_tessellation& t) { std::free(t.positions); }},  // NOLINT: not from malloc
      {"bad_index", [](const lc_mesh&, lc_tessellation& t) { t.triangles[1] = 0xFFFFFFFF; }},
      {"bad_face", [](const lc_mesh&, lc_tessellation& t) { t.triangle_face[0] = -5; }},
      {"bad_provenance", [](const lc_mesh&, lc_tessellation& t) { t.provenance[0].denominator = 0; }},
      {"not_a_number",
       [](const lc_mesh&, lc_tessellation& t) {
         positions(t)[0] = std::numeric_limits<double>::quiet_NaN();
       }},
      {"infinite", [](const lc_mesh&, lc_tessellation& t) { positions(t)[0] = HUGE_VAL; }},
      {"nothing_at_all", [](const lc_mesh&, lc_tessellation& t) { std::memset(&t, 0, sizeof t); }},
      {"modify_positions",
       [](const lc_mesh& m, lc_tessellation&) { const_cast<double*>(m.positions)[4] += 1; }},
      {"modify_triangles",
       [](const lc_mesh& m, lc_tessellation&) { const_cast<std::int32_t*>(m.triangles)[0] ^= 1; }},
  };
  return all;
}

std::string behaviour(const char* options) {
  const std::string text = options != nullptr ? options : "";
  const std::string key = "behaviour=";
  return text.starts_with(key) ? text.substr(key.size()) : "";
}

struct Instance {
  void* inner = nullptr;
  lc_mesh mesh{};
  std::string how;
};

void misbehave(const std::string& how, const std::string& place) {
  const std::size_t at = how.find('@');
  if (at == std::string::npos || how.substr(at + 1) != place) return;
  const auto found = things().find(how.substr(0, at));
  if (found == things().end()) throw std::invalid_argument("no such behaviour: " + how);
  found->second();
}

// Constructed with the library and destroyed with it.
struct Last {
  std::string how;
  ~Last() { misbehave(how, "unload"); }
} last;

}  // namespace

// As libraries do that never look at the interface asked for; INTERFACE: the one that this was built for.
extern "C" const lc_subject* lc_subject_get(std::uint32_t) {
  static lc_subject subject = good();
  subject.abi = INTERFACE;
  subject.name = "behaviours";
  subject.options = "behaviour=THING@PLACE";
  subject.capabilities = [](const char* options, lc_capabilities* out, const char** message) {
    misbehave(behaviour(options), "capabilities");
    return good().capabilities(nullptr, out, message);
  };
  subject.create = [](const lc_mesh* mesh, const char* options, void** instance, const char** message) {
    auto* const made = new Instance{nullptr, *mesh, behaviour(options)};
    last.how = made->how;
    *instance = made;
    misbehave(made->how, "create");
    return good().create(mesh, nullptr, &made->inner, message);
  };
  subject.tessellate = [](void* instance, const lc_request* request, lc_tessellation* out,
                          const char** message) {
    const auto& self = *static_cast<Instance*>(instance);
    misbehave(self.how, "tessellate");
    const lc_status status = good().tessellate(self.inner, request, out, message);
    const std::size_t at = self.how.find("@answer");
    if (at != std::string::npos) spoils().at(self.how.substr(0, at))(self.mesh, *out);
    return status;
  };
  subject.release = [](void* instance, lc_tessellation*) {
    misbehave(static_cast<Instance*>(instance)->how, "release");
  };
  subject.destroy = [](void* instance) {
    auto* const self = static_cast<Instance*>(instance);
    good().destroy(self->inner);
    misbehave(self->how, "destroy");
    delete self;
  };
  return &subject;
}
