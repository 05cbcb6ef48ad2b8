#pragma once

#include <functional>
#include <string>
#include <vector>

#include "nda/options.hpp"

namespace nda::core {

/// What there is to know of one option.  validate(), the command line and docs/options.md all read
/// it here, so that a new option is a field of Options and a row of the table.
struct OptionRow {
  std::string name;  ///< the way to its field: "relaxation.max_evaluations"
  std::string rule;  ///< what it must be: "a whole number, 1 or more", "auto, relaxation or exact"
  std::string meaning;  ///< half a line

  std::function<bool(const Options&)> holds;        ///< whether the value obeys the rule
  std::function<std::string(const Options&)> text;  ///< the value as read() takes it, six digits
  /// Sets the value; returns false, and changes nothing, where the text breaks the rule.
  std::function<bool(const std::string& text, Options&)> read;
};

/// All options but `progress` and `stop`, in the order of their declaration.
const std::vector<OptionRow>& option_table();

/// The option of that name.  Throws InputError if there is none.
const OptionRow& find_option(const std::string& name);

/// Sets an option.  Throws InputError naming what is wrong; `options` are then unchanged.
void set_option(const std::string& name, const std::string& value, Options& options);

}  // namespace nda::core
