// SPDX-License-Identifier: MIT
#include "verify/host/isolation/worker.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/random.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "verify/host/host.h"
#include "verify/host/host_memory.h"
#include "verify/host/in_turns.h"
#include "verify/host/isolation/header.h"
#include "verify/host/subject_call.h"
#include "verify/subject/devices.h"
#include "verify/subject/lent_mesh.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::verify {

namespace {

using detail::Memory;
using protocol::Header;

// The host has ended: nothing can be reported.
struct HostGone {};

class Connection final : public protocol::Source {
 public:
  Connection(int in, int out) : in_(in), out_(out) {}

  void read(std::span<std::byte> to) override {
    while (!to.empty()) {
      const ssize_t n = ::read(in_, to.data(), to.size());
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) throw HostGone{};
      to = to.subspan(static_cast<std::size_t>(n));
    }
  }
  std::string line(std::size_t longest) override {
    std::string text;
    for (std::byte b{}; text.size() <= longest; text += static_cast<char>(b)) {
      read({&b, 1});
      if (b == std::byte{'\n'}) return text;
    }
    throw HostGone{};
  }
  void write(std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
      const ssize_t n = ::write(out_, bytes.data(), bytes.size());
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) throw HostGone{};
      bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
  }
  void write(const nlohmann::json& header) const {
    const std::string text = protocol::to_line(header);
    write(std::as_bytes(std::span(text)));
  }

 private:
  int in_, out_;
};

struct Loaded {
  const lc_subject& subject;
  std::string options;
  LentMesh mesh;
  void* instance = nullptr;
};

data::Scheme asked_scheme(const Header& header) {
  return header.choice("scheme", protocol::kSchemes) == 0 ? data::Scheme::kLoop : data::Scheme::kCatmullClark;
}

nlohmann::json capabilities_answer(const lc_subject& subject, const std::string& options,
                                   data::Scheme scheme) {
  lc_capabilities c{};
  try {
    c = capabilities(subject, options, scheme);
  } catch (const SubjectDied& wrong) {
    return {{"limitcheck", protocol::kVersion}, {"status", "ok"}, {"impossible", wrong.what()}};
  }
  std::string device;
  for (const auto& [name, noted] : Devices::noted()) device = noted;  // of the one subject of this process
  return {{"limitcheck", protocol::kVersion},
          {"status", "ok"},
          {"device", device},
          {"precision", c.precision == LC_FLOAT32 ? "float32" : "float64"},
          {"weights", c.weights == LC_WEIGHTS_LOOP ? "loop" : "warren"},
          {"boundary", c.boundary == LC_BOUNDARY_SPLINE ? "spline" : "none"},
          {"points", c.points == LC_POINTS_LIMIT ? "limit" : "refined"},
          {"schemes", protocol::names_of(c.schemes == 0 ? LC_DOES_LOOP : c.schemes, protocol::kSchemes)},
          {"sharp", protocol::names_of(c.sharp, protocol::kSharpKinds)},
          {"max_depth", c.max_depth},
          {"normals", c.normals != 0},
          {"per_face_depth", c.per_face_depth != 0},
          {"exact_lattice", c.exact_lattice != 0},
          {"does_not_validate", c.does_not_validate != 0},
          {"provenance", c.no_provenance == 0},
          {"channels", protocol::names_of(c.channel_rules, data::kChannelRules)},
          {"channel_derivatives", c.channel_derivatives != 0},
          {"points_anywhere", c.points_anywhere != 0},
          {"quads_only", c.quads_only != 0},
          {"options", subject.options != nullptr ? subject.options : ""}};
}

// [block, offset], null, or [-1, 0]: see replay.cpp.
nlohmann::json place(const Memory& memory, const void* pointer) {
  if (pointer == nullptr) return nullptr;
  const Memory::Block* block = memory.find(pointer);
  if (block == nullptr) return {-1, 0};
  return {block - memory.blocks().data(), static_cast<const std::byte*>(pointer) - block->data};
}

void tessellate(Loaded& loaded, const Header& header, Connection& host) {
  std::vector<std::int32_t> depth(header.integer("faces", 0, INT32_MAX));
  host.read(std::as_writable_bytes(std::span(depth)));
  const LentMesh before = loaded.mesh;

  Memory memory;
  const auto threads = static_cast<std::int32_t>(header.integer("threads", 1, INT32_MAX));
  const auto [delivered, release_threw] =
      detail::tessellate(loaded.subject, loaded.instance, depth, threads, memory);

  std::vector<std::array<std::int64_t, 3>> blocks;
  for (const Memory::Block& b : memory.blocks())
    blocks.push_back({static_cast<std::int64_t>(b.size), memory.written_before(b), memory.written_behind(b)});
  const bool mesh_changed = !(before == loaded.mesh);
  host.write({{"status", "ok"},
              {"vertices", delivered.vertex_count},
              {"triangles", delivered.triangle_count},
              {"blocks", blocks.size()},
              {"positions", place(memory, delivered.positions)},
              {"normals", place(memory, delivered.normals)},
              {"provenance", place(memory, delivered.provenance)},
              {"triangle_corners", place(memory, delivered.triangles)},
              {"triangle_face", place(memory, delivered.triangle_face)},
              {"corner", place(memory, delivered.corner)},
              {"channel_values", place(memory, delivered.channel_values)},
              {"channel_derivatives", place(memory, delivered.channel_derivatives)},
              {"mesh_changed", mesh_changed},
              {"release_threw", release_threw}});
  host.write(std::as_bytes(std::span(blocks)));
  for (const Memory::Block& b : memory.blocks()) host.write({b.data, b.size});
  if (mesh_changed)
    for (const std::span<const std::byte> array : protocol::arrays_of(loaded.mesh.view())) host.write(array);
}

// An exit status that no program ends with by chance: a library that ends the process while it is unloaded is
// found out by its own.
int unlikely_status() {
  std::uint8_t random = 0;
  if (getrandom(&random, sizeof random, GRND_NONBLOCK) != sizeof random)
    random = static_cast<std::uint8_t>(getpid());
  return 100 + random % 100;
}

void answer(const lc_subject& subject, std::optional<Loaded>& loaded, const Header& header,
            Connection& host) {
  const std::string request = header.text("request");
  if (request == "capabilities") {
    host.write(capabilities_answer(subject, header.text("options"), asked_scheme(header)));
  } else if (request == "create") {
    loaded.emplace(Loaded{subject, header.text("options"), {}});
    LentMesh& lent = loaded->mesh;
    lent.scheme = asked_scheme(header);
    lent.positions.resize(3 * header.integer("vertices", 0, INT32_MAX));
    lent.face_sizes.resize(header.integer("faces", 0, INT32_MAX));
    lent.corners.resize(header.integer("corners", 0, INT32_MAX));
    lent.sharp_edges.resize(header.integer("sharp_edges", 0, INT32_MAX));
    lent.sharp_vertices.resize(header.integer("sharp_vertices", 0, INT32_MAX));
    for (const protocol::ChannelHeader& c : header.channels())
      lent.channels.push_back({c.components, c.rule,
                               std::vector<double>(static_cast<std::size_t>(c.components * c.values)),
                               std::vector<std::int32_t>(lent.corners.size())});
    for (const auto& array : protocol::arrays_of(lent.view())) host.read(array);
    lent.creasing =
        header.choice("creasing", {"uniform", "chaikin"}) == 0 ? LC_CREASING_UNIFORM : LC_CREASING_CHAIKIN;
    lent.corners_held = header.flag("corners_held");
    lent.smooth_triangles = header.flag("smooth_triangles");
    const lc_mesh& mesh = lent.lend();
    detail::call(subject, "create", [&](const char** message) {
      return subject.create(&mesh, detail::text(loaded->options), &loaded->instance, message);
    });
    host.write({{"status", "ok"}});
  } else if (request == "tessellate") {
    tessellate(*loaded, header, host);
  } else if (request == "end") {
    if (loaded)
      detail::call(subject, "destroy", [&](const char**) {
        subject.destroy(loaded->instance);
        return LC_OK;
      });
    const int status = unlikely_status();
    host.write({{"status", "ok"}, {"exit", status}});
    std::exit(status);  // the library's own destructors run in here
  }
}

}  // namespace

int serve(int argc, char** argv, std::string_view kind,
          const lc_subject& (*open_subject)(const std::string&)) {
  const std::vector<std::string> words(argv, argv + argc);
  const bool in_turns = words.size() == 5 && words[4] == "--in-turns";
  if (!(words.size() == 4 || in_turns) || words[1] != "worker" || words[2] != kind) {
    fmt::print(stderr, "{}: `limitcheck audit` starts this program\n", program_invocation_short_name);
    return 2;
  }
  // The protocol moves away from standard output, which becomes the subject's to print on.
  const int out = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 10), in = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 10);
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (out < 0 || in < 0 || nothing < 0) return 1;
  dup2(STDERR_FILENO, STDOUT_FILENO);
  dup2(nothing, STDIN_FILENO);
  setvbuf(stdout, nullptr, _IOLBF, 0);
  // Sanitizers catch these to report and exit: the host wants to see the signal itself.
  for (const int s : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(s, SIG_DFL);
  Memory::note_overruns();

  Connection host(in, out);
  const lc_subject* subject = nullptr;
  std::optional<InTurns> turns;
  std::optional<Loaded> loaded;
  for (;;) {
    try {
      const Header header = protocol::read_header(host);
      try {
        if (subject == nullptr) {
          subject = &open_subject(words[3]);
          if (in_turns) subject = &turns.emplace(*subject).subject();
        }
        answer(*subject, loaded, header, host);
      } catch (const HostLacks& lack) {  // the host finds the same shortage, and says so
        host.write({{"limitcheck", protocol::kVersion}, {"status", "failed"}, {"message", lack.what}});
      } catch (const SubjectError& error) {
        host.write({{"limitcheck", protocol::kVersion},
                    {"status", protocol::kStatusWords[error.status()]},
                    {"message", error.what()}});
        if (header.text("request") == "create") loaded.reset();
      }
    } catch (const HostGone&) {
      break;
    }
  }
  return 0;
}

namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw SubjectError(LC_INVALID_INPUT, why);
}

}  // namespace

const lc_subject& load_subject(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) refuse("there is no such file");
  if (!std::filesystem::is_regular_file(file, error)) refuse("this is no file");
  // A path with a slash: a bare name would be looked for where the system keeps its libraries.
  void* library = dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) refuse(fmt::format("cannot be loaded as a shared library: {}", dlerror()));

  using Entry = const lc_subject* (*)(std::uint32_t);
  const auto entry = reinterpret_cast<Entry>(dlsym(library, LC_SUBJECT_ENTRY));
  if (entry == nullptr)
    refuse("does not export " LC_SUBJECT_ENTRY "(); <limitcheck/subject.h> says what it must return");
  // The latest interface that both have.
  const lc_subject* subject = nullptr;
  for (std::uint32_t abi = LC_SUBJECT_ABI; abi >= 1 && subject == nullptr; --abi) subject = entry(abi);
  if (subject == nullptr)
    refuse(fmt::format("offers no interface from 1 to {}, those of this program: " LC_SUBJECT_ENTRY
                       "() is NULL for each",
                       LC_SUBJECT_ABI));
  // Some never look at the interface asked for: the table says which it is of.
  if (subject->abi < 1 || subject->abi > LC_SUBJECT_ABI)
    refuse(fmt::format("was built for interface {}, this program has {}", subject->abi, LC_SUBJECT_ABI));
  if (subject->name == nullptr || subject->capabilities == nullptr || subject->create == nullptr ||
      subject->tessellate == nullptr || subject->release == nullptr || subject->destroy == nullptr)
    refuse("the table it returns has no name, or a function of it is NULL");
  return *subject;
}

}  // namespace limitcheck::verify
