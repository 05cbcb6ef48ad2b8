#include <iostream>
#include <memory>
#include <string>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "core/option_table.hpp"

namespace nda::cli {

Action declare_options(CLI::App& parser) {
  const auto name = std::make_shared<std::string>("default");
  parser.add_option("--preset", *name, preset_names())->capture_default_str();
  parser.footer(
      "Every option as `nda solve --set` takes it, with its value in the preset, what it means "
      "and\n"
      "what it must be.\n"
      "\n"
      "Example:\n"
      "  nda options --preset realtime");
  return [name] {
    const Options options = preset(*name);
    for (const core::OptionRow& row : core::option_table()) {
      std::cout << row.name << '=' << row.text(options) << "\n    " << row.meaning << ": "
                << row.rule << '\n';
    }
    return kAnswer;
  };
}

}  // namespace nda::cli
