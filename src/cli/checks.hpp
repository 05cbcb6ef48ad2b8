#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

namespace nda::cli {

// What an argument must be, said in one line where it is not.

/// A number, `least` or more.  NaN is refused.
CLI::Validator at_least(double least);

/// A whole number, `least` or more, below 2^bits.
/// @param bits  in [1, 64].
CLI::Validator whole_number(std::uint64_t least = 1, int bits = 64);

/// A finite number above `limit`.
CLI::Validator above(double limit);

/// The name of a file, not an empty string.
CLI::Validator file_name();

/// What the option of that name in core/option_table.hpp must be.
CLI::Validator as_option(const std::string& name);

/// Throws InputError where two outputs are one file; devices (/dev/null) may be written twice.
void require_two_files(const std::string& first, const std::string& second);

/// Throws InputError where writing `output` would replace `input`.
void require_other_file(const std::string& output, const std::string& input);

/// The names that --preset takes, for its help.
std::string preset_names();

}  // namespace nda::cli
