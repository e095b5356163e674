// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "verify/cli/commands.h"
#include "verify/host/in_turns.h"
#include "verify/host/isolation/worker.h"
#include "verify/subject/registry.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::cli {

const CLI::Validator kFinite(
    [](std::string& text) {
      double value = 0;
      return CLI::detail::lexical_cast(text, value) && !std::isfinite(value) ? text + " is no finite number"
                                                                             : std::string();
    },
    "");

namespace {

namespace fs = std::filesystem;

// A standard stream that the caller has closed would become the next file that is opened, and what is meant
// for the one would land in the other. Opened the wrong way round, so that its use is still an error.
void occupy_standard_streams() {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(fd, F_GETFD) < 0) (void)open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

// If there is no standard error either, nothing can be reported.
void complain(const std::string& text) {
  std::fputs(fmt::format("limitcheck: {}\n", text).c_str(), stderr);
}

// What the buffer of standard output still holds may fail to be written: then nothing was held or found.
int after_output(int exit_code) {
  if (exit_code == kBadInput) return exit_code;  // it has been said
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  complain(fmt::format("standard output cannot be written{}{}", errno != 0 ? ": " : "",
                       errno != 0 ? std::strerror(errno) : ""));
  return kBadInput;
}

// What to do next, for a word that is no command.
std::string what_was_meant(const std::string& word) {
  if (word.find('.') == std::string::npos && word.find('/') == std::string::npos)
    return "Run with --help for more information.\n";
  return fmt::format(
      "To look at a mesh:             limitcheck check {0}\n"
      "To audit all tessellators:     limitcheck audit {0}\n"
      "To audit one of them:          limitcheck audit row-stream {0}\n"
      "To tessellate it:              limitcheck tessellate {0} -o fine.obj\n"
      "Run with --help for more information.\n",
      word);
}

// limitcheck-NAME beside this program, in bench/ of a build tree, or where it is installed. Empty: not built.
fs::path find_program(const std::string& name) {
  std::error_code ignored;
  const fs::path here = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const char* folder : {".", "bench", "../libexec/limitcheck"}) {
    fs::path path = here / folder / ("limitcheck-" + name);
    if (access(path.c_str(), X_OK) == 0) return path;
  }
  return {};
}

// Returns only if it fails.
void become(const fs::path& path, const std::vector<std::string>& arguments) {
  std::string program = path.string();
  std::vector<std::string> copies = arguments;
  std::vector<char*> list{program.data()};
  for (std::string& argument : copies) list.push_back(argument.data());
  list.push_back(nullptr);
  execv(program.c_str(), list.data());
  fmt::print(stderr, "limitcheck: {}: {}\n", program, std::strerror(errno));
}

// A command that is a separate program: it needs libraries that limitcheck does without, or runs limitcheck itself.
void add_external(CLI::App& app, int& exit_code, const std::string& name, const std::string& description) {
  CLI::App* command = app.add_subcommand(name, description);
  command->set_help_flag();  // the program has its own
  command->prefix_command();
  command->callback([command, name, &exit_code] {
    exit_code = kBadInput;
    const fs::path path = find_program(name);
    if (path.empty()) {
      fmt::print(stderr, "limitcheck: '{}' is not built; configure with -DLIMITCHECK_BENCH=ON\n", name);
    } else {
      become(path, command->remaining());
    }
  });
}

// Hidden: the process that isolated subjects run in.
void add_worker(CLI::App& app, int& exit_code) {
  struct Arguments {
    std::string kind, what;
    bool in_turns = false;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("worker", "Serve one subject to an audit, on standard input and output");
  command->group("");
  command->add_option("KIND", a->kind)->required()->check(CLI::IsMember({"library", "built-in"}));
  command->add_option("WHAT", a->what, "A shared library, or the name of a built-in subject")->required();
  command->add_flag("--in-turns", a->in_turns, "Ask it for other things in between");
  command->callback([a, &exit_code] {
    std::optional<verify::InTurns> turns;
    exit_code = verify::serve([&]() -> const lc_subject& {
      const lc_subject* subject =
          a->kind == "library" ? &verify::load_subject(a->what) : verify::find_subject(a->what);
      if (subject == nullptr)
        throw verify::SubjectError(LC_INVALID_INPUT, "there is no such built-in subject");
      return a->in_turns ? turns.emplace(*subject).subject() : *subject;
    });
  });
}

int run(int argc, char** argv) {
  CLI::App app{
      "limitcheck: is a tessellator of subdivision surfaces right, by how much is it not, and how fast is "
      "it?"};
  app.set_version_flag("--version", "limitcheck " LIMITCHECK_VERSION);
  app.require_subcommand(1);
  app.footer(
      "First steps: limitcheck check mesh.obj; limitcheck audit mesh.obj; limitcheck COMMAND --help. "
      "Documentation: README.md, verify/subject/README.md, or share/doc/limitcheck where it is installed.\n"
      "Exit codes: 0 all held, 1 findings, 2 bad usage or input.");

  int exit_code = kHeld;
  add_audit(app, exit_code);
  add_hunt(app, exit_code);
  add_merge(app, exit_code);
  add_eval(app, exit_code);
  add_claims(app, exit_code);
  add_generate(app, exit_code);
  add_check(app, exit_code);
  add_repair(app, exit_code);
  add_prove(app, exit_code);
  add_mutants(app, exit_code);
  add_tessellate(app, exit_code);
  add_external(app, exit_code, "reproduce",
               "Reproduce the paper: claims, tables, figures, and one page that shows them");
  add_external(app, exit_code, "bench",
               "Performance tracking: measure, compare, hold exact costs, draw the trend");
  add_manual(app, exit_code);
  add_worker(app, exit_code);

  // `limitcheck help COMMAND` is `limitcheck COMMAND --help`.
  std::vector<const char*> words(argv, argv + argc);
  if (argc > 1 && std::string_view(argv[1]) == "help") {
    words.erase(words.begin() + 1);
    words.push_back("--help");
  }
  try {
    app.parse(static_cast<int>(words.size()), words.data());
  } catch (const CLI::RequiredError& error) {
    if (argc < 2) return app.exit(CLI::CallForHelp()), kBadInput;
    if (app.get_subcommands().empty() && argv[1][0] != '-') {
      fmt::print(stderr, "limitcheck: there is no command '{}'\n{}", argv[1], what_was_meant(argv[1]));
      return kBadInput;
    }
    app.exit(error);
    return kBadInput;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kHeld : kBadInput;
  } catch (const std::bad_alloc&) {
    std::fputs("limitcheck: out of memory\n", stderr);
    return kBadInput;
  } catch (const std::exception& error) {
    complain(error.what());
    return kBadInput;
  }
  return exit_code;
}

}  // namespace
}  // namespace limitcheck::cli

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of writing, not an end in the middle
  limitcheck::cli::occupy_standard_streams();
  return limitcheck::cli::after_output(limitcheck::cli::run(argc, argv));
}
