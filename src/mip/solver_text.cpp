#include "mip/solver_text.hpp"

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace nda::mip {

std::vector<std::string> read_lines(const std::string& path) {
  std::vector<std::string> lines;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream stream(line);
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::optional<double> number_in(const std::string& word) {
  if (word.empty()) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (*end != '\0' || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::size_t> count_in(const std::string& word) {
  const std::optional<double> value = number_in(word);
  if (!value || *value < 0 || *value >= 0x1p53 || *value != std::floor(*value)) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(*value);
}

std::optional<double> lowered_number_in(const std::string& word) {
  const std::optional<double> value = number_in(word);
  if (!value) return std::nullopt;
  const std::size_t mantissa_end = std::min(word.find_first_of("eE"), word.size());
  const std::size_t point = std::min(word.find('.'), mantissa_end);
  const std::size_t decimals = point == mantissa_end ? 0 : mantissa_end - point - 1;
  const double exponent =
      mantissa_end == word.size() ? 0.0 : std::atof(word.c_str() + mantissa_end + 1);
  return *value - std::pow(10.0, exponent - static_cast<double>(decimals));
}

std::vector<std::string> words_after_last(const std::vector<std::string>& lines,
                                          std::string_view key) {
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    const std::size_t place = line->find(key);
    if (place != std::string::npos) return words_of(line->substr(place + key.size()));
  }
  return {};
}

}  // namespace nda::mip
