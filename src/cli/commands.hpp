#pragma once

#include "cli/command.hpp"

namespace nda::cli {

// What each <name>_command.cpp defines: Command::declare of that command.

Action declare_solve(CLI::App& parser);
Action declare_options(CLI::App& parser);
Action declare_check(CLI::App& parser);
Action declare_info(CLI::App& parser);
Action declare_convert(CLI::App& parser);
Action declare_generate(CLI::App& parser);
Action declare_compare(CLI::App& parser);

}  // namespace nda::cli
