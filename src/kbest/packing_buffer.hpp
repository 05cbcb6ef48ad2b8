#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "kbest/arc_sets.hpp"
#include "nda/types.hpp"

namespace nda::kbest {

/// So many of a list are handed on whatever the clock says.
inline constexpr std::size_t kFewPackings = 10;

/// The k best packings ever found, no two the same; of equal cost those found first: the solution
/// buffer of partial branch and bound, and what every ranking knows.
class PackingBuffer {
 public:
  struct Kept {
    double cost;
    std::uint64_t number;  ///< they were found in this order
    const std::vector<core::ArcId>* arcs;
  };

  explicit PackingBuffer(std::size_t k) : k_(k) {}
  PackingBuffer(PackingBuffer&&) = default;
  PackingBuffer& operator=(PackingBuffer&&) = default;

  /// Keeps it if it is new and among the k best.  Its arcs ascend, and their cost is always the
  /// same.  Returns whether it did.  Cost: O(log k), and its arcs once.
  bool add(core::Packing packing);
  /// All of a list, best first, or those that there is time for, and a few.
  void add_best(std::vector<core::Packing> packings, const core::Deadline& deadline);

  /// What a packing must cost less than to be kept; +inf as long as there are fewer than k.
  double cutoff() const { return size() < k_ ? kInfinity : last().cost; }

  std::size_t capacity() const { return k_; }
  std::size_t size() const { return arcs_.size(); }
  /// Keeps so many from now on.
  void resize(std::size_t k);
  /// Best first, until one is added.  Cost: O(k) after additions, and sorting these.
  const std::vector<Kept>& packings();
  /// The same, or those that there is time for, and a few; nothing is left.
  std::vector<core::Packing> take(const core::Deadline& deadline = {});

 private:
  bool is_last_recent() const;
  const Kept& last() const { return is_last_recent() ? recent_.front() : sorted_.back(); }
  void drop_last();

  std::size_t k_;
  ArcSets arcs_;
  std::vector<Kept> sorted_;
  std::vector<Kept> recent_;  // a heap, the last on top
  std::uint64_t num_found_ = 0;
};

}  // namespace nda::kbest
