// SPDX-License-Identifier: MIT
#include "verify/host/isolation/remote_subject.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <span>
#include <stdexcept>
#include <utility>

#include "data/error.h"
#include "data/io/write.h"
#include "data/validate.h"
#include "verify/subject/devices.h"
#include "verify/subject/lent_mesh.h"
#include "verify/subject/shell_word.h"

namespace limitcheck::verify {

namespace {

std::uint64_t fnv1a(std::string_view text, std::uint64_t hash) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash;
}

}  // namespace

// The functions behind the table. capabilities() and create() get no pointer to their subject, so each remote
// subject has a pair of its own, which the compiler makes for each of 64 slots.
struct RemoteCalls {
  struct Instance {
    RemoteSubject& subject;
    std::unique_ptr<ChildProcess> child;
    protocol::Capabilities capabilities;
    lc_mesh mesh;
    std::string options;
    bool release_threw = false;
  };

  static constexpr std::size_t kSlots = 64;
  static std::array<RemoteSubject*, kSlots>& slots() {
    static std::array<RemoteSubject*, kSlots> all{};
    return all;
  }

  // What was asked when it broke down.
  struct Call {
    const std::string& options;
    const lc_mesh* mesh = nullptr;              // none: it did not get one yet
    std::span<const std::int32_t> depths = {};  // none: it was not asked to tessellate
  };

  // Saves the control mesh (OBJ, bit for bit) and, unless all are the same, the depths of the faces (one per line) in the
  // witness folder, under names made from their contents, so that the same breakdown is kept once. Returns "; again with:
  // limitcheck audit ...", or why nothing could be saved. Never throws.
  static std::string save_input(const RemoteSubject& s, const Call& call) try {
    const bool program = s.kind_ == RemoteSubject::Kind::kProgram;
    const ProcessLimits& limits = s.settings_.limits;
    std::string command = fmt::format("limitcheck audit {}{}", program ? "--program " : "",
                                      shell_word(program ? s.what_ : s.name_));
    std::string rest = s.kind_ == RemoteSubject::Kind::kBuiltIn ? " --isolate" : "";
    if (!call.options.empty()) rest += fmt::format(" --options {}", shell_word(call.options));
    if (limits.seconds != ProcessLimits().seconds) rest += fmt::format(" --timeout {}", limits.seconds);
    if (limits.memory_mib != ProcessLimits().memory_mib)
      rest += fmt::format(" --memory {}", limits.memory_mib);
    const std::filesystem::path place(s.settings_.witness_folder);
    if (call.mesh == nullptr || place.empty()) return fmt::format("; again with: {}{}", command, rest);

    std::filesystem::create_directories(place);
    const data::ControlMesh mesh = control_mesh(*call.mesh);
    const std::uint64_t hash = fnv1a(data::mesh_content(mesh, data::FileFormat::kObj), 0xcbf29ce484222325ULL);
    const auto mesh_file = place / fmt::format("{:016x}.obj", hash);
    data::write_mesh(mesh_file, mesh);
    command += fmt::format(" {}", shell_word(mesh_file.string()));
    const data::Scheme scheme = scheme_of(call.mesh->scheme);
    if (scheme != data::natural_scheme(mesh)) command += fmt::format(" --scheme {}", data::name_of(scheme));
    if (!data::validate(mesh, scheme).empty())
      return fmt::format("; again with: {}{} --must-refuse", command, rest);

    if (!call.depths.empty()) {
      const auto [least, most] = std::minmax_element(call.depths.begin(), call.depths.end());
      command += fmt::format(" --depth {}", std::max(*most, 0));
      if (*least != *most || *least < 0) {
        std::string lines;
        for (const std::int32_t d : call.depths) lines += fmt::format("{}\n", d);
        const auto depth_file = place / fmt::format("{:016x}.depths", fnv1a(lines, hash));
        std::ofstream out(depth_file, std::ios::binary);
        out << lines;
        out.close();
        if (!out) return fmt::format("; cannot write {}", depth_file.string());
        command += fmt::format(" --depths {}", shell_word(fmt::format("file:{}", depth_file.string())));
      }
    }
    return fmt::format("; again with: {}{}", command, rest);
  } catch (const std::exception& error) {
    return fmt::format("; its input could not be saved: {}", error.what());
  }

  // Errors of the process, and refusals, as statuses of the plug-in interface.
  template <class Work>
  static lc_status answer(RemoteSubject& s, ChildProcess& child, const char** message, const Call& call,
                          Work&& work) {
    static thread_local std::string text;
    const auto died = [&](const SubjectDied& e) {
      const std::string saved = save_input(s, call);
      throw SubjectDied(e.kind(), fmt::format("{}: {}{}", s.name_, e.what(), saved));
    };
    try {
      try {
        work();
        return LC_OK;
      } catch (const protocol::Error& error) {
        child.fail(SubjectDied::Kind::kProtocol, fmt::format("broke the protocol: {}", error.what()));
      }
    } catch (const std::bad_alloc&) {
      throw HostLacks{"this program ran out of memory"};
    } catch (const SubjectDied& error) {
      // A program that has answered once can be started: a later failure is the program's own.
      if (!child.not_started() || s.has_answered_) died(error);
      text = error.what();  // a wrong command line, not a fault of the subject
      *message = text.c_str();
      return LC_INVALID_INPUT;
    } catch (const SubjectError& refusal) {
      text = refusal.what();
      *message = text.c_str();
      return refusal.status();
    }
    return LC_FAILED;
  }

  static lc_status capabilities(RemoteSubject& s, const char* options, lc_capabilities* out,
                                const char** message) {
    const std::string given = options != nullptr ? options : "";
    s.waiting_.reset();
    auto child = s.start();
    const lc_status status = answer(s, *child, message, {given}, [&] {
      child->ask(protocol::ask_capabilities(given, out->scheme));
      s.capabilities_ = protocol::read_capabilities(*child);
      s.options_text_ = s.capabilities_.options;
      s.subject_.options = s.options_text_.c_str();
      if (!s.capabilities_.device.empty()) Devices::note(s.name_, s.capabilities_.device);
      const lc_scheme scheme = out->scheme;
      *out = s.capabilities_.values;
      out->size = sizeof *out;
      out->scheme = scheme;
    });
    s.has_answered_ = s.has_answered_ || !child->not_started();
    s.containment_ = child->containment();
    if (status == LC_OK) {
      s.waiting_ = std::move(child);
      s.waiting_options_ = given;
      s.waiting_scheme_ = out->scheme;
    }
    return status;
  }

  static lc_status create(RemoteSubject& s, const lc_mesh* mesh, const char* options, void** instance,
                          const char** message) {
    const std::string given = options != nullptr ? options : "";
    if (s.waiting_ == nullptr || s.waiting_options_ != given || s.waiting_scheme_ != mesh->scheme) {
      lc_capabilities ignored{};
      ignored.scheme = mesh->scheme;
      if (const lc_status status = capabilities(s, options, &ignored, message); status != LC_OK)
        return status;
    }
    auto made = std::make_unique<Instance>(
        Instance{s, std::exchange(s.waiting_, nullptr), s.capabilities_, *mesh, given});
    const lc_status status = answer(s, *made->child, message, {given, mesh}, [&] {
      made->child->ask(protocol::ask_create(*mesh, given, made->capabilities));
      protocol::read_created(*made->child);
    });
    if (status == LC_OK) *instance = made.release();
    return status;
  }

  static lc_status tessellate(void* instance, const lc_request* request, lc_tessellation* out,
                              const char** message) {
    auto& i = *static_cast<Instance*>(instance);
    const std::span depth(request->face_depth, static_cast<std::size_t>(i.mesh.face_count));
    const std::uint64_t most = i.subject.settings_.limits.memory_bytes();
    return answer(i.subject, *i.child, message, {i.options, &i.mesh, depth}, [&] {
      i.child->ask(protocol::ask_tessellate(depth, request->threads, i.capabilities));
      if (i.subject.kind_ == RemoteSubject::Kind::kProgram) {
        protocol::read_tessellation(*i.child, i.capabilities, most, i.mesh, *request, *out);
      } else {
        i.release_threw = protocol::read_replay(*i.child, most, i.mesh, *request, *out);
      }
    });
  }

  static void release(void* instance, lc_tessellation*) {
    if (std::exchange(static_cast<Instance*>(instance)->release_threw, false))
      throw std::runtime_error("release() threw in its process");
  }

  static void destroy(void* instance) {
    const std::unique_ptr<Instance> i(static_cast<Instance*>(instance));
    if (!i->child->alive()) return;  // it was told when it happened
    const char* message = nullptr;
    const lc_status status = answer(i->subject, *i->child, &message, {i->options, &i->mesh}, [&] {
      if (i->subject.kind_ == RemoteSubject::Kind::kProgram) {
        i->child->finish();
      } else {
        i->child->ask(protocol::ask_end());
        i->child->finish(protocol::read_ended(*i->child));
      }
    });
    if (status != LC_OK) throw SubjectError(status, message);
  }

  template <std::size_t Slot>
  static void install_slot(lc_subject& table) {
    table.capabilities = [](const char* options, lc_capabilities* out, const char** message) {
      return capabilities(*slots()[Slot], options, out, message);
    };
    table.create = [](const lc_mesh* mesh, const char* options, void** instance, const char** message) {
      return create(*slots()[Slot], mesh, options, instance, message);
    };
  }
  template <std::size_t... Slot>
  static void install(lc_subject& table, std::size_t slot, std::index_sequence<Slot...>) {
    static constexpr std::array kInstall{&RemoteCalls::install_slot<Slot>...};
    kInstall[slot](table);
  }
};

RemoteSubject::RemoteSubject(Kind kind, std::string what, IsolationSettings settings)
    : kind_(kind),
      what_(std::move(what)),
      name_((kind == Kind::kProgram  ? "program:"
             : kind == Kind::kShader ? "shader:"
                                     : "") +
            what_),
      settings_(std::move(settings)) {
  auto& slots = RemoteCalls::slots();
  while (slot_ < slots.size() && slots[slot_] != nullptr) ++slot_;
  if (slot_ == slots.size()) throw data::ArgumentError("more than 64 subjects in processes of their own");
  slots[slot_] = this;
  subject_.abi = LC_SUBJECT_ABI;
  subject_.name = name_.c_str();
  receipt_.subject = name_;
  subject_.description = "runs in a process of its own";
  RemoteCalls::install(subject_, slot_, std::make_index_sequence<RemoteCalls::kSlots>());
  subject_.tessellate = &RemoteCalls::tessellate;
  subject_.release = &RemoteCalls::release;
  subject_.destroy = &RemoteCalls::destroy;
}

RemoteSubject::~RemoteSubject() {
  RemoteCalls::slots()[slot_] = nullptr;
}

std::unique_ptr<ChildProcess> RemoteSubject::start() {
  const char* const kind = kind_ == Kind::kLibrary  ? "library"
                           : kind_ == Kind::kShader ? "shader"
                                                    : "built-in";
  std::vector<std::string> command{settings_.worker, "worker", kind, what_};
  if (kind_ == Kind::kProgram) command = {"/bin/sh", "-c", what_};
  if (settings_.in_turns) command.emplace_back("--in-turns");
  return std::make_unique<ChildProcess>(command, settings_.limits, &receipt_);
}

}  // namespace limitcheck::verify
