#include "cli/checks.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "core/option_table.hpp"

namespace nda::cli {

CLI::Validator at_least(double least) {
  return CLI::Validator(
      [least](const std::string& text) {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= least) return std::string();
        char rule[64];
        std::snprintf(rule, sizeof rule, "' given, it must be a number, %.6g or more", least);
        return "'" + text + rule;
      },
      "");
}

CLI::Validator whole_number(std::uint64_t least, int bits) {
  return CLI::Validator(
      [least, bits](const std::string& text) {
        std::uint64_t value = 0;
        const char* end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, value);
        const bool is_whole = error == std::errc() && stop == end;
        const bool fits = value >> (bits - 1) <= 1;  // by 64 there is no shift
        if (is_whole && value >= least && fits) return std::string();
        return "'" + text + "' given, it must be a whole number, " + std::to_string(least) +
               " or more, below 2^" + std::to_string(bits);
      },
      "");
}

CLI::Validator above(double limit) {
  return CLI::Validator(
      [limit](const std::string& text) {
        double value = 0;
        const bool is_number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
        if (is_number && value > limit) return std::string();
        char rule[64];
        std::snprintf(rule, sizeof rule, "' given, it must be a finite number above %.6g", limit);
        return "'" + text + rule;
      },
      "");
}

CLI::Validator file_name() {
  return CLI::Validator(
      [](const std::string& text) {
        return std::string(text.empty() ? "'' given, it must name a file" : "");
      },
      "");
}

CLI::Validator as_option(const std::string& name) {
  return CLI::Validator(
      [name](const std::string& text) {
        Options scratch;
        try {
          core::set_option(name, text, scratch);
        } catch (const InputError& error) {
          return std::string(error.what());
        }
        return std::string();
      },
      "");
}

void require_two_files(const std::string& first, const std::string& second) {
  // Neither need exist yet.
  const auto place = [](const std::string& name) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(name));
  };
  if (first.empty() || second.empty()) return;
  std::error_code not_there;
  if (std::filesystem::exists(second, not_there) &&
      !std::filesystem::is_regular_file(second, not_there))
    return;
  if (place(first) == place(second))
    throw InputError(second + ": cannot write: the other output is the same file");
}

void require_other_file(const std::string& output, const std::string& input) {
  std::error_code not_there;
  if (std::filesystem::equivalent(output, input, not_there)) {
    throw InputError(output + ": cannot write: it is the problem itself");
  }
}

std::string preset_names() {
  std::string names;
  for (const PresetInfo& line : presets())
    names += std::string(names.empty() ? "" : ", ") + line.name;
  return names;
}

}  // namespace nda::cli
