#include "cli/commands.hpp"

namespace nda::cli {
namespace {

constexpr Command kCommands[] = {
    {"solve", "find the best assignment and a bound that proves how good it is", declare_solve},
    {"options", "list what can be set of a solve: value, meaning, range", declare_options},
    {"check", "verify a solution, its cost and its bound independently", declare_check},
    {"info", "sizes, components and what the cost shift leaves of a problem", declare_info},
    {"convert", "read a problem in one format and write it in another", declare_convert},
    {"generate", "make a problem of a benchmark family", declare_generate},
    {"compare", "one table: every method on the same files", declare_compare},
};

}  // namespace

std::span<const Command> commands() {
  return kCommands;
}

}  // namespace nda::cli
