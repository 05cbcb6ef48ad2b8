#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace nda::bnb {

/// A set of numbers below 64 * kWords, one bit each.
template <std::size_t kWords>
class ArcSet {
 public:
  void insert(std::uint32_t a) { words_[a / 64] |= bit(a); }
  void erase(std::uint32_t a) { words_[a / 64] &= ~bit(a); }
  bool contains(std::uint32_t a) const { return (words_[a / 64] & bit(a)) != 0; }

  /// How many numbers are also in `other`.
  std::uint32_t count_common(const ArcSet& other) const {
    int count = 0;
    for (std::size_t w = 0; w < kWords; ++w) count += std::popcount(words_[w] & other.words_[w]);
    return static_cast<std::uint32_t>(count);
  }

  ArcSet& operator&=(const ArcSet& other) {
    for (std::size_t w = 0; w < kWords; ++w) words_[w] &= other.words_[w];
    return *this;
  }
  ArcSet& operator|=(const ArcSet& other) {
    for (std::size_t w = 0; w < kWords; ++w) words_[w] |= other.words_[w];
    return *this;
  }
  ArcSet& operator-=(const ArcSet& other) {
    for (std::size_t w = 0; w < kWords; ++w) words_[w] &= ~other.words_[w];
    return *this;
  }

  /// Ascending.
  template <typename Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t w = 0; w < kWords; ++w) {
      for (std::uint64_t word = words_[w]; word != 0; word &= word - 1)
        visit(static_cast<std::uint32_t>(64 * w) +
              static_cast<std::uint32_t>(std::countr_zero(word)));
    }
  }

 private:
  static std::uint64_t bit(std::uint32_t a) { return std::uint64_t{1} << (a % 64); }

  std::array<std::uint64_t, kWords> words_{};
};

}  // namespace nda::bnb
