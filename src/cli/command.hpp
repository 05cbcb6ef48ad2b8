#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <span>

namespace nda::cli {

/// Exit codes: what a script wants to know.
inline constexpr int kAnswer = 0;    ///< the question was answered
inline constexpr int kNoAnswer = 1;  ///< infeasible, or a check failed
inline constexpr int kBadInput = 2;  ///< bad input, usage, or a file that cannot be read or written
inline constexpr int kStopped = 3;   ///< a limit stopped the work with a usable answer

/// Does the work of a command and returns the exit code.  Results go to std::cout, everything else
/// to std::cerr; a write to std::cout that fails throws.  InputError and all other exceptions
/// become one line on std::cerr and kBadInput.
using Action = std::function<int()>;

/// One command of the program.
struct Command {
  const char* name;
  const char* summary;  ///< one line for the list of commands

  /// Declares options and positionals on the command's parser and a footer with a worked example
  /// ("Example:\n  nda ..."); returns what is to be done after parsing.
  Action (*declare)(CLI::App& parser);
};

/// All commands, in the order of --help.  A new one needs a file <name>_command.cpp, a declaration
/// in commands.hpp and a line in commands.cpp.
std::span<const Command> commands();

}  // namespace nda::cli
