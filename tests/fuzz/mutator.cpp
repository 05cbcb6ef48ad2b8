#include "fuzz/mutator.hpp"

#include <algorithm>
#include <cctype>

namespace nda::fuzz {
namespace {

const char* const kWords[] = {"0",
                              "-1",
                              "1",
                              "2147483647",
                              "2147483648",
                              "4294967295",
                              "4294967296",
                              "4000000000",
                              "9007199254740993",
                              "18446744073709551615",
                              "18446744073709551616",
                              "1e308",
                              "1e309",
                              "5e-324",
                              "1e-400",
                              "-0.0",
                              "nan",
                              "inf",
                              "-inf",
                              "0x10",
                              "+",
                              "-",
                              ".",
                              "e",
                              ",",
                              "\"",
                              "\n",
                              "\r\n",
                              "\t",
                              " ",
                              "\na 1 1 1",
                              "\np nda 2 1 1 1",
                              "\nb 1 1 1 1",
                              "\nc",
                              "nda",
                              "cost",
                              "i1",
                              "null",
                              "[]",
                              "{}",
                              "[",
                              "]",
                              "\\u0000",
                              "\xef\xbb\xbf",
                              "\xff",
                              "\x1f\x8b"};

std::size_t place(const std::string& text, core::Random& random) {
  return static_cast<std::size_t>(random.below(text.size() + 1));
}

std::string piece(const std::string& text, core::Random& random) {
  constexpr std::uint64_t kLongest = 40;
  return text.substr(place(text, random), static_cast<std::size_t>(random.below(kLongest)));
}

std::string word(core::Random& random) {
  return kWords[random.below(std::size(kWords))];
}

// Puts a word in the place of a number.
void replace_number(std::string& text, core::Random& random) {
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  const auto from = text.begin() + static_cast<std::ptrdiff_t>(place(text, random));
  const auto first = std::find_if(from, text.end(), is_digit);
  text.replace(first, std::find_if_not(first, text.end(), is_digit), word(random));
}

void mutate_once(std::string& text, const std::vector<std::string>& seeds, core::Random& random) {
  const std::size_t at = place(text, random);
  switch (random.below(8)) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << random.below(8)));
      break;
    case 1:
      text.insert(at, 1, static_cast<char>(random.below(256)));
      break;
    case 2:
      text.erase(at, static_cast<std::size_t>(random.below(8)));
      break;
    case 3:
      text.insert(at, word(random));
      break;
    case 4:
      text.insert(at, piece(text, random));
      break;
    case 5:
      text.insert(at, piece(seeds[random.below(seeds.size())], random));
      break;
    case 6:
      text.resize(at);
      break;
    default:
      replace_number(text, random);
      break;
  }
}

}  // namespace

std::string mutated(const std::string& text,
                    const std::vector<std::string>& seeds,
                    core::Random& random) {
  std::string result = text;
  const std::uint64_t num_changes = 1 + random.below(4);
  for (std::uint64_t i = 0; i < num_changes; ++i) mutate_once(result, seeds, random);
  return result;
}

}  // namespace nda::fuzz
