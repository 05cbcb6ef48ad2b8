#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
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
// most one line on standard error.  A pipe that closes early must not kill the program silently:
// SIGPIPE is ignored and the failed write reported like a full disk.

namespace nda::cli {
namespace {

int fail(const std::string& message) {
  std::cerr << "nda: " << message << '\n';
  return kBadInput;
}

// Results count only when they have left the program.
int flush_results(int code) {
  errno = 0;
  if (std::cout.flush()) return code;
  const std::string why = errno != 0 ? std::strerror(errno) : "write failed";
  return fail("standard output: cannot write: " + why);
}

int run(const Action& action) {
  try {
    return flush_results(action());
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
  for (const CLI::App* subcommand : parser.get_subcommands()) {
    return " (nda " + subcommand->get_name() + " --help shows the usage)";
  }
  return " (nda --help lists the commands)";
}

// --help and --version end here too; usage errors are one line.
int finish_parsing(const CLI::App& parser, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return flush_results(parser.exit(error, std::cout, std::cerr));
  return fail(error.what() + advice(parser));
}

bool is_command(std::string_view name) {
  return std::any_of(commands().begin(), commands().end(), [&](const Command& command) {
    return name == command.name;
  });
}

int main_program(int argc, char** argv) {
  CLI::App parser("N-dimensional assignment with a bound anyone can check.", "nda");
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
    return finish_parsing(parser, error);
  }
  for (const auto& [subcommand, action] : actions) {
    if (subcommand->parsed()) return run(action);
  }
  return fail("no command given (nda --help lists the commands)");
}

}  // namespace
}  // namespace nda::cli

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);
  return nda::cli::main_program(argc, argv);
}
