// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <sstream>

#include <commit.h>  // made by the build (commit.cmake)
#include "data/error.h"
#include "verify/cli/commands.h"
#include "verify/cli/screen.h"
#include "verify/report/columns.h"
#include "verify/row/visible_text.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::cli {

const CLI::Validator kFinite(
    [](std::string& text) {
      double value = 0;
      return CLI::detail::lexical_cast(text, value) && !std::isfinite(value) ? text + " is no finite number"
                                                                             : std::string();
    },
    "");

const CLI::Validator kNotEmpty(
    [](std::string& text) { return text.empty() ? std::string("it is empty") : std::string(); }, "");
const CLI::Validator kSeed(
    [](std::string& text) {
      errno = 0;
      (void)std::strtoull(text.c_str(), nullptr, 0);  // takes -1 for the largest, and nothing for 0
      return errno == ERANGE || text.empty() || text.starts_with('-')
                 ? "'" + text + "' is no whole number from 0 to 18446744073709551615"
                 : std::string();
    },
    "");

namespace {

int output_error = 0;  // errno of the first time that standard output could not be written
std::vector<std::string> command_line;

namespace fs = std::filesystem;

// A standard stream that the caller has closed would become the next file that is opened, and what is meant
// for the one would land in the other. Opened the wrong way round, so that its use is still an error.
void occupy_standard_streams() {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(fd, F_GETFD) < 0) (void)open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

// If there is no standard error either, nothing can be reported.
void complain(const std::string& text) {
  say(stderr, "limitcheck: {}\n", text);
}

// What the buffer of standard output still holds may fail to be written: then nothing was held or found. A reader that
// went away is no error; where SIGPIPE is not ignored it has ended the program with this exit code already.
int after_output(int exit_code) {
  if (exit_code == kBadInput) return exit_code;  // it has been said
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  const int error = output_error != 0 ? output_error : errno;
  if (error == EPIPE) return kSignalled + SIGPIPE;
  complain(fmt::format("standard output cannot be written{}{}", error != 0 ? ": " : "",
                       error != 0 ? std::strerror(error) : ""));
  return kBadInput;
}

// Help, or what is wrong with the arguments.
int exit_with(const CLI::App& app, const CLI::Error& error) {
  std::ostringstream out, err;
  const int code = app.exit(error, out, err);
  say_lines(out.str());
  say_text(stderr, err.str());
  return code;
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

bool is_command(const CLI::App& app, const std::string& word) {
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  return std::ranges::any_of(commands, [&](const CLI::App* command) { return command->check_name(word); });
}

constexpr const char* kTags =
    R"(Sharp edges and vertices, and what else a control mesh says beside its faces: lines of an OBJ file that OpenSubdiv
reads, too. Vertices and faces count from 0 in them.

  t crease 2/1/0 A B S              the edge from vertex A to vertex B has the sharpness S: 0.5, 23/10; 10 and more stays sharp
  t corner 1/1/0 V S                vertex V has the sharpness S
  t interpolateboundary 1/0/0 1     boundary vertices of one face are held (2, or no such line: they are not)
  t creasemethod 0/0/1 chaikin      sharpness falls by Chaikin's rule (normal, or no such line: by 1 in each step)
  t smoothtriangles 0/0/1 smooth    Catmull-Clark's scheme: OpenSubdiv's other rule for triangles (catmark: the usual one)
  t hole 1/0/0 F                    face F shapes its neighbours and is not shown

`limitcheck generate creased-cube:2 -o creased.obj` writes an example, and `limitcheck check creased.obj` says what is read.
)";

int parse(CLI::App& app, int argc, char** argv, const int& exit_code) {
  // `limitcheck help COMMAND` is `limitcheck COMMAND --help`.
  std::vector<const char*> words(argv, argv + argc);
  if (argc == 3 && std::string_view(argv[1]) == "help" && std::string_view(argv[2]) == "tags") {
    say_lines(kTags);
    return kHeld;
  }
  if (argc > 2 && std::string_view(argv[1]) == "help" && !is_command(app, argv[2])) {
    say(stderr,
        "limitcheck: there is no command '{}', nor a text about it; the one text is `limitcheck help "
        "tags`\n{}",
        argv[2], what_was_meant(argv[2]));
    return kBadInput;
  }
  if (argc > 1 && std::string_view(argv[1]) == "help") {
    words.erase(words.begin() + 1);
    words.push_back("--help");
  }
  return guarded([&] {
    try {
      app.parse(static_cast<int>(words.size()), words.data());
    } catch (const CLI::RequiredError& error) {
      if (argc < 2) return exit_with(app, CLI::CallForHelp()), int{kBadInput};
      if (app.get_subcommands().empty() && argv[1][0] != '-')
        say(stderr, "limitcheck: there is no command '{}'\n{}", argv[1], what_was_meant(argv[1]));
      else
        exit_with(app, error);
      return int{kBadInput};
    } catch (const CLI::ParseError& error) {
      return int{exit_with(app, error) == 0 ? kHeld : kBadInput};
    }
    return exit_code;
  });
}

}  // namespace

int guarded(const std::function<int()>& work) try { return work(); } catch (const std::bad_alloc&) {
  std::fputs("limitcheck: out of memory\n", stderr);
  return kBadInput;
} catch (const verify::HostLacks& lack) {
  complain(lack.text());
  return kBadInput;
} catch (const std::exception& error) {
  complain(error.what());
  return kBadInput;
}

void say_text(std::FILE* stream, const std::string& text) {
  const std::string shown = verify::visible_text(text);
  errno = 0;
  if (std::fwrite(shown.data(), 1, shown.size(), stream) != shown.size() && stream == stdout &&
      output_error == 0)
    output_error = errno;
}

void say_lines(const std::string& text) {
  say_text(stdout, verify::wrapped(text, screen_width(STDOUT_FILENO)));
}

fs::path program_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error)
    throw data::ArgumentError("where this program lies cannot be found out: there is no /proc/self/exe");
  return program.parent_path();
}

fs::path find_program(const std::string& name) {
  const fs::path here = program_folder();
  for (const char* folder : {".", "bench", "../libexec/limitcheck"}) {
    fs::path path = here / folder / ("limitcheck-" + name);
    if (access(path.c_str(), X_OK) == 0) return path;
  }
  return {};
}

std::string dumped(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

int run_program(CLI::App& app, int argc, char** argv, const int& exit_code) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of writing, not an end in the middle
  occupy_standard_streams();
  command_line.assign(argv + std::min(argc, 1), argv + argc);
  app.set_version_flag("--version", "limitcheck " LIMITCHECK_VERSION LIMITCHECK_COMMIT);
  app.require_subcommand(1);
  return after_output(parse(app, argc, argv, exit_code));
}

int hand_over(const std::string& name, const std::vector<std::string>& arguments) {
  const std::string program = find_program(name).string();
  if (program.empty()) {
    say(stderr,
        "limitcheck: '{0}' is not here: a build of the sources has it, as `bash verify/run.sh {0}` makes "
        "it\n",
        name);
    return kBadInput;
  }
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> list;
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  execv(program.c_str(), list.data());
  say(stderr, "limitcheck: {}: {}\n", program, std::strerror(errno));
  return kBadInput;
}

int hand_over(const std::string& name) {
  return hand_over(name, command_line);
}

}  // namespace limitcheck::cli
