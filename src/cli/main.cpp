#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <ios>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "nda/types.hpp"
#include "nda/version.hpp"

// Parses the command line, runs one command and turns whatever happens into an exit code and at
// most one line on standard error.  Results count only when they have left the program: all are
// written to std::cout, which throws when a write fails.  A pipe that closes early must not kill
// the program silently: SIGPIPE is ignored and the failed write reported like a full disk.

namespace nda::cli {
namespace {

int fail(const std::string& message) {
  std::cout.exceptions(std::ios_base::goodbit);  // std::cerr flushes it, and so does the end
  std::cerr << "nda: " << message << '\n';
  return kBadInput;
}

int run(const Action& action) {
  try {
    const int code = action();
    std::cout.flush();
    return code;
  } catch (const std::ios_base::failure&) {
    return fail(std::string("standard output: cannot write: ") + std::strerror(errno));
  } catch (const InputError& error) {
    return fail(error.what());
  } catch (const std::bad_alloc&) {
    return fail("out of memory");
  } catch (const std::exception& error) {
    return fail(std::string("internal error: ") + error.what());
  }
}

// Where to look up the usage of what was asked for.
std::string advice(const CLI::App& parser) {
  std::string command = "nda";
  for (const CLI::App* app = &parser; !app->get_subcommands().empty();) {
    app = app->get_subcommands().front();
    command += " " + app->get_name();
  }
  return " (" + command + " --help " +
         (command == "nda" ? "lists the commands)" : "shows the usage)");
}

// --help and --version end here too; usage errors are one line.
int finish_parsing(const CLI::App& parser, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return parser.exit(error, std::cout, std::cerr);
  return fail(error.what() + advice(parser));
}

bool is_command(std::string_view name) {
  return std::any_of(commands().begin(), commands().end(), [&](const Command& command) {
    return name == command.name;
  });
}

int main_program(int argc, char** argv) {
  CLI::App parser("N-dimensional assignment with bounds, and a certificate anyone can check.",
                  "nda");
  parser.set_version_flag("--version", std::string("nda ") + kVersion);
  parser.footer(
      "Exit codes: 0 answer, 1 no answer or check failed, 2 bad input, 3 stopped by a limit.\n"
      "\n"
      "Example:\n"
      "  nda convert --help");
  std::vector<std::pair<CLI::App*, Action>> actions;
  for (const Command& command : commands()) {
    CLI::App* subcommand = parser.add_subcommand(command.name, command.summary);
    actions.emplace_back(subcommand, command.declare(*subcommand));
  }
  if (argc > 1 && argv[1][0] != '-' && !is_command(argv[1])) {
    return fail("unknown command '" + std::string(argv[1]) + "' (nda --help lists the commands)");
  }
  try {
    parser.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return run([&] { return finish_parsing(parser, error); });
  }
  for (const auto& [subcommand, action] : actions) {
    if (subcommand->parsed()) return run(action);
  }
  return fail("no command given (nda --help lists the commands)");
}

// The number of a standard stream that the caller closed would go to the next file that is opened,
// and results end up in it.  What takes the number here can be neither read nor written.
void occupy_closed_streams() {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(file, F_GETFD) >= 0) continue;
    ::open("/dev/null", file == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

}  // namespace
}  // namespace nda::cli

int main(int argc, char** argv) {
  nda::cli::occupy_closed_streams();
  std::signal(SIGPIPE, SIG_IGN);
  std::cout.exceptions(std::ios_base::badbit);
  return nda::cli::main_program(argc, argv);
}
