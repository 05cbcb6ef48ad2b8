#pragma once

#include <string>
#include <vector>

#include "cli/commands.hpp"

namespace nda::cli {

/// The families that `nda generate` knows, as the command line itself has them.
inline std::vector<std::string> family_names() {
  CLI::App parser;
  declare_generate(parser);
  std::vector<std::string> names;
  for (const CLI::App* family : parser.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(family->get_name());
  return names;
}

}  // namespace nda::cli
