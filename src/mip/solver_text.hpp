#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nda::mip {

// Bits of parsing that the adapters share.

/// The lines of a file, without their ends; none when it cannot be read.
std::vector<std::string> read_lines(const std::string& path);

/// The words of a line, separated by blanks.
std::vector<std::string> words_of(const std::string& line);

/// The number that a word is, "inf" and "nan" excluded; nothing when it is anything else.
std::optional<double> number_in(const std::string& word);

/// The whole number from 0 that a word is, below 2^53.
std::optional<std::size_t> count_in(const std::string& word);

/// The number lowered by one unit of its last decimal digit, whatever way that was rounded:
/// "-208.534" becomes -208.535, "-2.05e+02" becomes -206.  A bound read so is a bound.
std::optional<double> lowered_number_in(const std::string& word);

/// What follows `key` in the last line that has it, as words; empty when none has.
std::vector<std::string> words_after_last(const std::vector<std::string>& lines,
                                          std::string_view key);

}  // namespace nda::mip
