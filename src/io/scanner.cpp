#include "io/scanner.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>

#include "nda/types.hpp"

// The bytes stand in one buffer, closed by a newline that is not part of the file, so that no inner
// loop needs a bounds check: every number and word ends there at the latest.  At the beginning of a
// line at least kMaxLine bytes are in the buffer unless the source has ended; a line that reaches
// the closing newline before the end of the source was therefore too long.
//
// Most costs in files have at most 15 digits and a small exponent.  Then mantissa and power of ten
// are exact doubles, and one multiplication or division rounds correctly (Clinger 1990, "How to
// read floating point numbers accurately"); all others go to std::from_chars.

namespace nda::io {
namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 18;
static_assert(kBuffer >= 4 * Scanner::kMaxLine);

constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr int kLargestExactPower = 22;
constexpr std::uint64_t kLargestExactMantissa = std::uint64_t{1} << 53;
constexpr int kMaxDigits = 19;  // without overflow of 64 bits

// Digits at p, appended to the mantissa; returns the first character behind them.
const char* read_digits(const char* p, std::uint64_t& mantissa) {
  for (unsigned digit = 0; (digit = static_cast<unsigned>(*p - '0')) <= 9; ++p) {
    mantissa = mantissa * 10 + digit;
  }
  return p;
}

// The exponent part at p, if there is one; returns the first character behind it.
const char* read_exponent(const char* p, int& exponent) {
  if (*p != 'e' && *p != 'E') return p;
  const char* first = p + 1;
  const bool negative = *first == '-';
  if (*first == '-' || *first == '+') ++first;
  std::uint64_t magnitude = 0;
  const char* last = read_digits(first, magnitude);
  constexpr std::ptrdiff_t kMaxExponentDigits = 4;
  if (last == first || last - first > kMaxExponentDigits) return p;
  exponent += negative ? -static_cast<int>(magnitude) : static_cast<int>(magnitude);
  return last;
}

}  // namespace

Scanner::Scanner(Source& source)
    : source_(source),
      buffer_(std::make_unique_for_overwrite<char[]>(kBuffer + 1)),
      cursor_(buffer_.get()),
      end_(buffer_.get()) {
  refill();
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  const std::string_view start(cursor_, static_cast<std::size_t>(end_ - cursor_));
  if (start.substr(0, kByteOrderMark.size()) == kByteOrderMark) cursor_ += kByteOrderMark.size();
}

bool Scanner::next_line() {
  for (;;) {
    make_room();
    if (cursor_ == end_) return false;
    if (!at_line_end()) return true;
    finish_line();
  }
}

bool Scanner::next_word() {
  for (;;) {
    make_room();
    if (!at_line_end()) {
      make_room();
      return true;
    }
    if (cursor_ != end_) {
      ++cursor_;
      ++line_;
    } else if (ended_) {
      return false;
    }
  }
}

void Scanner::skip_line() {
  for (;;) {
    const auto left = static_cast<std::size_t>(end_ - cursor_);
    const void* newline = std::memchr(cursor_, '\n', left);
    if (newline != nullptr) {
      cursor_ = static_cast<const char*>(newline) + 1;
      ++line_;
      return;
    }
    cursor_ = end_;
    if (ended_) return;
    refill();
  }
}

void Scanner::finish_line() {
  if (!at_line_end()) fail("unexpected " + found());
  refuse_if_cut_off(cursor_);
  if (cursor_ == end_) return;
  ++cursor_;
  ++line_;
}

bool Scanner::read_double(double& value) {
  skip_blanks();
  const char* p = cursor_;
  const bool negative = *p == '-';
  if (*p == '-' || *p == '+') ++p;
  const char* first = p;
  std::uint64_t mantissa = 0;
  int exponent = 0;
  p = read_digits(p, mantissa);
  std::ptrdiff_t num_digits = p - first;
  if (*p == '.') {
    const char* point = p;
    p = read_digits(p + 1, mantissa);
    exponent = -static_cast<int>(std::min<std::ptrdiff_t>(p - point - 1, kMaxLine));
    num_digits += p - point - 1;
  }
  if (num_digits > 0) p = read_exponent(p, exponent);
  const bool simple = num_digits > 0 && num_digits <= kMaxDigits && is_delimiter(*p) &&
                      mantissa <= kLargestExactMantissa && exponent >= -kLargestExactPower &&
                      exponent <= kLargestExactPower;
  if (!simple) return read_double_slowly(value);
  const double magnitude = exponent < 0 ? static_cast<double>(mantissa) / kPowersOfTen[-exponent]
                                        : static_cast<double>(mantissa) * kPowersOfTen[exponent];
  refuse_if_cut_off(p);
  value = negative ? -magnitude : magnitude;
  cursor_ = p;
  return true;
}

bool Scanner::read_double_slowly(double& value) {
  std::string_view text = word();
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const char* last = text.data() + text.size();
  refuse_if_cut_off(last);
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error != std::errc() || end != last) return false;
  cursor_ = last;
  return true;
}

std::string_view Scanner::word() {
  skip_blanks();
  const char* p = cursor_;
  while (!is_delimiter(*p)) ++p;
  return {cursor_, static_cast<std::size_t>(p - cursor_)};
}

std::string Scanner::found() {
  const std::string_view text = word();
  refuse_if_cut_off(cursor_ + text.size());
  if (!text.empty()) return in_quotes(text);
  if (*cursor_ != '\n') return in_quotes({cursor_, 1});
  return cursor_ == end_ ? "the end of the file" : "the end of the line";
}

void Scanner::make_room() {
  if (static_cast<std::size_t>(end_ - cursor_) < kMaxLine && !ended_) refill();
}

// Moves what is left to the front and fills the buffer as far as the source allows.
void Scanner::refill() {
  char* first = buffer_.get();
  auto count = static_cast<std::size_t>(end_ - cursor_);
  std::memmove(first, cursor_, count);
  while (count < kBuffer && !ended_) {
    std::size_t more = 0;
    try {
      more = source_.read(first + count, kBuffer - count);
    } catch (const InputError& error) {
      fail(error.what());
    }
    count += more;
    bytes_read_ += more;
    ended_ = more == 0;
  }
  cursor_ = first;
  end_ = first + count;
  first[count] = '\n';
}

void Scanner::fail_long_line() const {
  fail("line is longer than " + std::to_string(kMaxLine) + " characters");
}

void Scanner::fail(const std::string& message) const {
  throw InputError("line " + std::to_string(line_) + ": " + message);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 32;
  constexpr char kHex[] = "0123456789abcdef";
  std::string result = "'";
  for (const char c : text.substr(0, kLongest)) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20 && code < 0x7f) {
      result += c;
    } else {
      result += {'\\', 'x', kHex[code >> 4], kHex[code & 15]};
    }
  }
  return result + (text.size() > kLongest ? "...'" : "'");
}

}  // namespace nda::io
