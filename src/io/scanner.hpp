#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "io/source.hpp"

namespace nda::io {

/// Reads words and numbers from the lines of a source and knows the line for messages.
///
/// Words are separated by blanks (space, tab, carriage return: so CRLF needs no care).  A call that
/// reads from the line never runs into the next one.  A line that is read must not exceed
/// kMaxLine characters; one that is skipped may.  Not thread safe.
class Scanner {
 public:
  static constexpr std::size_t kMaxLine = std::size_t{1} << 14;

  /// The source must outlive the scanner.
  explicit Scanner(Source& source);

  /// At the beginning of a line: moves to the first line that is not blank and to its first
  /// character.  False at the end of the source.
  bool next_line();

  /// Moves to the next word on this or a later line.  False at the end of the source.
  bool next_word();

  /// Leaves the current line, whatever is left on it.
  void skip_line();

  /// The character at the cursor; a newline at the end of a line.
  char peek() const { return *cursor_; }
  void advance() { ++cursor_; }

  /// True at a word that is this single character.
  bool at_word(char c) const { return *cursor_ == c && is_delimiter(cursor_[1]); }

  void skip_blanks() {
    while (is_blank(*cursor_)) ++cursor_;
  }

  /// True when only blanks are left on the line; the cursor then stands at its end.
  bool at_line_end() {
    skip_blanks();
    return *cursor_ == '\n';
  }

  /// Ends the line: throws "unexpected ..." when something else is left on it.
  void finish_line();

  /// A whole number at the cursor, blanks before it skipped.  On success moves behind it; false
  /// when there is none, it is followed by something other than a delimiter, or it exceeds 64 bits.
  bool read_unsigned(std::uint64_t& value);

  /// The same for a number (decimal, exponent, inf, nan), correctly rounded.  False too when it is
  /// beyond the range of double.
  bool read_double(double& value);

  /// The word at the cursor as it would appear in a message: quoted, unprintable characters
  /// escaped, cut when long; "the end of the line" or "the end of the file".
  std::string found();

  /// The characters up to the next delimiter.
  std::string_view word();

  /// Lines count from 1.
  std::size_t line() const { return line_; }

  /// Bytes taken from the source so far.
  std::size_t bytes_read() const { return bytes_read_; }

  /// An upper bound on the bytes of the whole source; exact once the end was seen.
  std::size_t max_bytes() const { return ended_ ? bytes_read_ : source_.max_bytes(); }
  std::size_t likely_bytes() const { return ended_ ? bytes_read_ : source_.likely_bytes(); }

  /// Throws InputError "line 12: message".
  [[noreturn]] void fail(const std::string& message) const;

  /// A comma, too, ends words and numbers.
  void set_comma_delimited() { comma_ = ','; }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  bool is_delimiter(char c) const { return is_blank(c) || c == '\n' || c == comma_; }
  bool read_double_slowly(double& value);
  void make_room();
  void refill();
  void refuse_if_cut_off(const char* p) const {
    if (p == end_ && !ended_) fail_long_line();
  }
  [[noreturn]] void fail_long_line() const;

  Source& source_;
  std::unique_ptr<char[]> buffer_;  // one more than is read into: a newline stands at *end_
  const char* cursor_;
  const char* end_;
  std::size_t line_ = 1;
  std::size_t bytes_read_ = 0;
  bool ended_ = false;
  char comma_ = '\n';
};

/// Text for a message: quoted, unprintable characters escaped, cut after 32 characters.
std::string in_quotes(std::string_view text);

inline bool Scanner::read_unsigned(std::uint64_t& value) {
  skip_blanks();
  const char* p = cursor_;
  std::uint64_t sum = 0;
  for (unsigned digit = 0; (digit = static_cast<unsigned>(*p - '0')) <= 9; ++p) {
    sum = sum * 10 + digit;
  }
  constexpr std::ptrdiff_t kSafeDigits = 19;
  if (p == cursor_ || p - cursor_ > kSafeDigits || !is_delimiter(*p)) return false;
  refuse_if_cut_off(p);
  cursor_ = p;
  value = sum;
  return true;
}

}  // namespace nda::io
