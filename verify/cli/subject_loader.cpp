// SPDX-License-Identifier: MIT
#include "verify/cli/subject_loader.h"

#include <unistd.h>

#include <algorithm>
#include <stdexcept>

#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "data/io/whole_content.h"
#include "verify/checks/check_oracle.h"
#include "verify/cli/commands.h"
#include "verify/host/host.h"
#include "verify/host/isolation/keeper.h"
#include "verify/subject/registry.h"
#include "verify/subject/shell_word.h"

namespace limitcheck::cli {
namespace {

namespace fs = std::filesystem;
using Kind = verify::RemoteSubject::Kind;

bool is_file(const std::string& name) {
  std::error_code ignored;
  return fs::is_regular_file(name, ignored);
}

bool is_mesh_name(const std::string& text) {
  const std::string word = text.substr(0, text.find(':'));
  const auto all = data::named_meshes();
  return std::ranges::any_of(
      all, [&](const data::NamedMesh& m) { return m.name.substr(0, m.name.find_first_of(":[")) == word; });
}

bool names_a_library(const std::string& name) {
  const std::string file = fs::path(name).filename();
  return file.ends_with(".so") || file.find(".so.") != std::string::npos;
}

// For /bin/sh, which would look for a bare name where programs are installed.
std::string as_command(const std::string& file) {
  return verify::shell_word(file.find('/') == std::string::npos ? "./" + file : file);
}

// Throws data::ArgumentError if the subject takes any option without a word, and its help text has none of the name of
// one of these.
void refuse_unknown_options(const lc_subject& subject, const std::string& options) {
  if (options.empty()) return;
  try {
    (void)verify::capabilities(subject, "limitcheck-asks-for-what-nobody-has=1");
  } catch (const std::exception&) {
    return;  // it knows its options
  }
  const std::string_view help = subject.options != nullptr ? subject.options : "";
  for (const std::string& option : CLI::detail::split(options, ',')) {
    const std::string key = option.substr(0, option.find('='));
    if (help.find(key + "=") == std::string_view::npos)
      throw data::ArgumentError(
          fmt::format("{} takes any option without a word, so nothing says that it knows '{}': let it refuse "
                      "what it does not know, or name it in its options text",
                      subject.name, key));
  }
}

}  // namespace

void add_subject_settings(CLI::App& command, std::vector<std::string>& options) {
  command.add_option("--option,--options", options, "key=value,... for the subject; may be repeated")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
}

void add_subject_options(CLI::App& command, SubjectArguments& a) {
  add_value(command, "--program", a.program, "COMMAND",
            "Audit the program that COMMAND starts (by /bin/sh) instead of SUBJECT; it speaks the protocol "
            "of verify/host/isolation/PROTOCOL.md");
  add_value(command, "--shader", a.shader, "FILE",
            "Audit this GLSL file instead of SUBJECT: a function of a place, compute passes, or a "
            "tessellation shader, as verify/subject/SHADERS.md has them")
      ->excludes("--program");
  command.add_flag("--isolate", a.isolate, "Run built-in subjects in a process of their own too");
  add_number(command, "--timeout", a.limits.seconds, 0.001, 86400.0,
             "Seconds a process may take for one answer")
      ->check(kFinite);
  add_number(command, "--memory", a.limits.memory_mib, std::int64_t{1}, std::int64_t{1} << 24,
             "MiB of memory a process may take, and its answer");
  add_words(command, "--containment", a.limits.namespaces, {{"auto", true}, {"subreaper", false}},
            "How a process is held, so that nothing it starts is left behind: auto is a PID namespace of its "
            "own where the system allows that, and elsewhere a subreaper");
  command
      .add_option("--witness-folder", a.witness_folder,
                  "Where control mesh and depths are saved when a process breaks down; '' for nowhere")
      ->type_name("DIR")
      ->capture_default_str();
  group(command, "Subjects of your own (libraries, programs and shaders run in a process of their own)",
        {"--program", "--shader", "--isolate", "--timeout", "--memory", "--containment", "--witness-folder"});
}

void take_program(const SubjectArguments& a, std::string& subject, std::vector<std::string>& meshes) {
  if (a.program.empty() && a.shader.empty()) return;
  if (!subject.empty()) meshes.insert(meshes.begin(), subject);
  subject = a.program.empty() ? "shader:" + a.shader : "program:" + a.program;
}

void take_mesh(const SubjectArguments& a, std::string& subject, std::vector<std::string>& meshes) {
  if (!a.program.empty() || !a.shader.empty() || subject.empty() || subject == "all" ||
      subject.starts_with("program:") || subject.starts_with("shader:"))
    return;
  if (verify::find_subject(subject.substr(0, subject.find(':'))) != nullptr) return;
  for (const verify::MissingSubject& missing : verify::missing_subjects())
    if (missing.name == subject) return;
  const std::string type = fs::path(subject).extension();
  const bool file = type == ".obj" || type == ".off" || type == ".ply" || type == ".stl";
  if (!file && (is_file(subject) || !is_mesh_name(subject))) return;
  if (file && !is_file(subject))
    throw data::ArgumentError(
        fmt::format("there is no file {}. `limitcheck audit MESH` audits all subjects on a mesh, `limitcheck "
                    "audit SUBJECT MESH` one; `limitcheck generate pawn -o {}` writes a mesh",
                    subject, subject));
  say(stderr, "limitcheck: {} is a mesh: all built-in subjects are audited on it\n", subject);
  meshes.insert(meshes.begin(), subject);
  subject = "all";
}

SubjectLoader::SubjectLoader(SubjectArguments arguments) : arguments_(std::move(arguments)) {
  verify::use_keeper(find_program("keeper"));
}

const lc_subject* SubjectLoader::remote(Kind kind, const std::string& what, bool in_turns) {
  verify::IsolationSettings settings{
      .limits = arguments_.limits, .witness_folder = arguments_.witness_folder, .in_turns = in_turns};
  const auto needed = [](const char* name, const char* what) {
    const fs::path program = find_program(name);
    if (program.empty())
      throw data::ArgumentError(
          fmt::format("limitcheck-{}, which {}, is not where it belongs: beside limitcheck", name, what));
    return program;
  };
  (void)needed("keeper", "holds processes");
  if (kind == Kind::kShader) settings.worker = needed("shader", "runs shaders");
  if (kind == Kind::kLibrary) settings.worker = needed("worker", "serves libraries");
  remote_.push_back(std::make_unique<verify::RemoteSubject>(kind, what, settings));
  return &remote_.back()->subject();
}

std::string SubjectLoader::containment() const {
  for (const auto& remote : remote_)
    if (const auto how = remote->containment())
      return *how == verify::Containment::kNamespace
                 ? "each in a PID namespace, that ends with it"
                 : "each under a subreaper, that ends what it has started";
  return "";
}

std::vector<verify::Receipt> SubjectLoader::receipts() const {
  std::vector<verify::Receipt> all;
  for (const auto& remote : remote_)
    if (remote->receipt().processes > 0) add(all, remote->receipt());
  return all;
}

verify::AuditSubject SubjectLoader::open(const std::string& text, const std::vector<std::string>& options) {
  verify::AuditSubject opened = open(text);
  for (const std::string& o : options) opened.options += (opened.options.empty() ? "" : ",") + o;
  const lc_subject* subject = opened.subject;
  try {
    (void)verify::capabilities(*subject, opened.options);
    refuse_unknown_options(*subject, opened.options);
  } catch (const verify::SubjectDied&) {  // the audit reports it
  } catch (
      const verify::SubjectError& error) {  // not the subject's fault: nobody has asked it for anything yet
    throw data::ArgumentError(fmt::format("{}{}{}", error.what(), subject->options ? "; options: " : "",
                                          subject->options ? subject->options : ""));
  }
  return opened;
}

verify::AuditSubject SubjectLoader::built_in(const lc_subject& subject) {
  return arguments_.isolate ? wrapped(Kind::kBuiltIn, subject.name) : verify::AuditSubject{&subject, ""};
}

verify::AuditSubject SubjectLoader::open(const std::string& text) {
  if (text.starts_with("program:")) return {remote(Kind::kProgram, text.substr(8)), ""};
  if (text.starts_with("shader:")) return wrapped(Kind::kShader, text.substr(7));
  if (text.ends_with(".glsl") && is_file(text)) return wrapped(Kind::kShader, text);

  // A file name may contain a colon: the longest that exists wins.
  std::size_t colon = is_file(text) ? std::string::npos : text.find(':');
  const std::string name = text.substr(0, colon);
  const std::string options = colon == std::string::npos ? "" : text.substr(colon + 1);
  if (text == "oracle") return {&verify::oracle_subject(), ""};
  if (const lc_subject* subject = verify::find_subject(name)) {
    verify::AuditSubject found = built_in(*subject);
    found.options = options;
    return found;
  }
  if (is_file(name) && !names_a_library(name) && ::access(name.c_str(), X_OK) == 0)
    return {remote(Kind::kProgram, as_command(name)), options};
  if (is_file(name) || name.find('/') != std::string::npos || names_a_library(name))
    return wrapped(Kind::kLibrary, name, options);

  for (const verify::MissingSubject& missing : verify::missing_subjects())
    if (missing.name == name) throw data::ArgumentError(missing.why);
  std::string known = "all";
  for (const lc_subject* s : verify::built_in_subjects()) known += fmt::format(", {}", s->name);
  throw data::ArgumentError(
      fmt::format("there is no subject '{}'; there are: {}, shared libraries (./lib{}.so), programs "
                  "(program:COMMAND) and shaders (shader:FILE)",
                  name, known, name));
}

}  // namespace limitcheck::cli
