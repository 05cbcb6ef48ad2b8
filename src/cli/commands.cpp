#include "cli/commands.hpp"

namespace nda::cli {
namespace {

constexpr Command kCommands[] = {
    {"convert", "read a problem in one format and write it in another", declare_convert},
    {"generate", "make a problem of a benchmark family", declare_generate},
};

}  // namespace

std::span<const Command> commands() {
  return kCommands;
}

}  // namespace nda::cli
