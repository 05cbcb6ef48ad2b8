#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "nda/types.hpp"

namespace nda::core {

// How checkers write what they find wrong.

/// Twelve digits.
inline std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

/// "(1 0 7)".
inline std::string tuple_text(const std::vector<Index>& tuple) {
  std::string text = "(";
  for (const Index i : tuple) {
    if (text.size() > 1) text += ' ';
    text += std::to_string(i);
  }
  return text + ")";
}

/// "index 7 of dimension 1", given dimension 0.
inline std::string index_text(std::size_t dimension, std::size_t index) {
  return "index " + std::to_string(index) + " of dimension " + std::to_string(dimension + 1);
}

}  // namespace nda::core
