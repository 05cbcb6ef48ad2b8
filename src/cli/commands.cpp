#include "cli/commands.hpp"

namespace nda::cli {
namespace {

constexpr Command kCommands[] = {
    {"convert", "read a problem in one format and write it in another", declare_convert},
};

}  // namespace

std::span<const Command> commands() {
  return kCommands;
}

}  // namespace nda::cli
