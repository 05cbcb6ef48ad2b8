#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nda/baselines.hpp"

namespace nda::baselines {

/// Worth of an arc against leaving its indices alone: shifted cost, of which each forbidden
/// singleton takes away a price beyond all others.  {0, 0} is leaving alone.
struct Value {
  int forced = 0;      ///< covered indices whose singleton is forbidden
  double shifted = 0;  ///< cost less the finite singleton costs

  /// Better values are less.
  friend bool operator<(const Value& a, const Value& b) {
    return a.forced != b.forced ? a.forced > b.forced : a.shifted < b.shifted;
  }
  Value& operator+=(const Value& other) {
    forced += other.forced;
    shifted += other.shifted;
    return *this;
  }
};

/// The arcs better than leaving alone, best first (ties in lexicographic order of the tuples).
/// A *rank* counts them from 0; a *slot* numbers the real indices of all dimensions from 0.
/// Built in O(A log A + A N); 4 bytes for every real index of an arc, 24 for the arc.
class RankedArcs {
 public:
  explicit RankedArcs(const Problem& problem);

  std::size_t size() const { return arcs_.size(); }
  std::size_t num_slots() const { return num_slots_; }
  std::span<const std::uint32_t> slots(std::size_t rank) const {
    return {slots_.data() + start_[rank], start_[rank + 1] - start_[rank]};
  }
  const Value& value(std::size_t rank) const { return arcs_[rank].value; }
  std::uint32_t arc(std::size_t rank) const { return arcs_[rank].arc; }

 private:
  struct Entry {
    Value value;
    std::uint32_t arc;
  };
  std::vector<Entry> arcs_;
  std::vector<std::size_t> start_;  // size() + 1 entries
  std::vector<std::uint32_t> slots_;
  std::size_t num_slots_ = 0;
};

/// Which slots are covered, for many constructions in a row: clear() is O(1).
class Cover {
 public:
  explicit Cover(std::size_t num_slots) : epoch_of_(num_slots, 0) {}

  void clear() { ++epoch_; }
  bool is_free(std::span<const std::uint32_t> slots) const {
    for (const std::uint32_t slot : slots) {
      if (epoch_of_[slot] == epoch_) return false;
    }
    return true;
  }
  void add(std::span<const std::uint32_t> slots) {
    for (const std::uint32_t slot : slots) epoch_of_[slot] = epoch_;
  }

 private:
  std::vector<std::uint32_t> epoch_of_;
  std::uint32_t epoch_ = 1;
};

/// Takes, in order, every arc from rank 0 on that fits, and adds it to `cover` and `chosen`.
void complete_greedily(const RankedArcs& ranked, Cover& cover, std::vector<std::size_t>& chosen);

/// Sum of the values of the chosen ranks.
Value total_value(const RankedArcs& ranked, std::span<const std::size_t> chosen);

/// What an index that `used` arcs use costs besides them, singletons being as few as its bounds
/// allow, or as many where they pay; +inf where the bounds cannot be kept.
long double cost_alone(UseBounds bounds, double singleton, Index used);

/// The result that these arcs (numbers in the problem, all different) make up; its cost is added in
/// long double.
BaselineResult make_result(const Problem& problem, std::vector<std::uint32_t> arcs);
BaselineResult make_result(const Problem& problem,
                           const RankedArcs& ranked,
                           std::span<const std::size_t> chosen);

}  // namespace nda::baselines
