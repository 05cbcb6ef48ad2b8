#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include "generate/option_tables.hpp"
#include "generate/portable.hpp"

namespace nda::generate {

/// Collects the command that makes a generated file again, its first comment.
class Parameters {
 public:
  Parameters(const std::string& family, std::uint64_t seed)
      : command_("nda generate " + family + " --seed " + std::to_string(seed)) {}

  /// All options of a family.
  template <typename Options>
  Parameters(const std::string& family, const Options& options) : Parameters(family, options.seed) {
    add_rows(OptionTable<Options>::kRows, options);
  }

  template <typename Rows, typename Options>
  void add_rows(const Rows& rows, const Options& options) {
    for_each_row(rows, [&](const auto& row) {
      const auto value = options.*row.field;
      if constexpr (std::is_floating_point_v<decltype(value)>) {
        add(row.name, shortest(value, true));
      } else {
        add(row.name, std::to_string(value));
      }
    });
  }

  void add(const char* name, const std::string& value) {
    command_ += ' ';
    command_ += flag_of(name);
    command_ += ' ';
    command_ += value;
  }

  const std::string& command() const { return command_; }

 private:
  std::string command_;
};

}  // namespace nda::generate
