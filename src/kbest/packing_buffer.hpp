#pragma once

#include <cstddef>
#include <vector>

#include "core/component.hpp"
#include "nda/types.hpp"

namespace nda::kbest {

/// The solution buffer of partial branch and bound: the k best packings ever found, best first, no
/// two the same.
class PackingBuffer {
 public:
  explicit PackingBuffer(std::size_t k) : k_(k) {}

  /// Keeps it if it is new and among the k best.  Its arcs ascend.  Cost: O(k), and its arcs for
  /// every packing of the same cost.  Returns whether it did.
  bool add(core::Packing packing);

  /// What a packing must cost less than to be kept; +inf as long as there are fewer than k.
  double cutoff() const { return packings_.size() < k_ ? kInfinity : packings_.back().cost; }

  std::size_t capacity() const { return k_; }
  const std::vector<core::Packing>& packings() const { return packings_; }
  std::vector<core::Packing> take() { return std::move(packings_); }

 private:
  std::size_t k_;
  std::vector<core::Packing> packings_;
};

}  // namespace nda::kbest
