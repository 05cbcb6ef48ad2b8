#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace nda::core {

/// xoshiro256** seeded by splitmix64 (Blackman & Vigna, public domain): the same stream on every
/// platform, which std::uniform_*_distribution does not promise.
class Random {
 public:
  using result_type = std::uint64_t;

  explicit Random(std::uint64_t seed) {
    for (std::uint64_t& word : state_) {
      seed += 0x9e3779b97f4a7c15ULL;
      std::uint64_t z = seed;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
      word = z ^ (z >> 31);
    }
  }

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return ~result_type{0}; }

  result_type operator()() {
    const std::uint64_t result = rotate(state_[1] * 5, 7) * 9;
    const std::uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = rotate(state_[3], 45);
    return result;
  }

  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>((*this)() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Uniform in 0..n-1, n >= 1 (multiply-shift; its bias is below 2^-32 for n < 2^32).
  std::uint64_t below(std::uint64_t n) {
    return n >> 32 ? (*this)() % n : (((*this)() >> 32) * n) >> 32;
  }

 private:
  static std::uint64_t rotate(std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }
  std::array<std::uint64_t, 4> state_;
};

/// Fisher-Yates; `draw.below(n)` is uniform in 0..n-1.
template <typename T, typename Draw>
void shuffle(std::vector<T>& values, Draw& draw) {
  for (std::size_t n = values.size(); n > 1; --n) std::swap(values[n - 1], values[draw.below(n)]);
}

}  // namespace nda::core
