#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/random.hpp"
#include "recovery/gain_packing.hpp"

namespace nda::recovery {

/// Tabu search over packings by swaps (Wu, Hao & Glover 2012): the arc that gains most comes in,
/// what excludes it leaves and may not come back for a while.
class SwapSearch {
 public:
  /// Keeps a reference.
  explicit SwapSearch(const Rivals& rivals) : rivals_(rivals), packing_(rivals) {}

  struct Limits {
    double max_work = 0;  ///< in the units of bnb::SlackLimits, some 3e8 a second
    std::size_t max_starts = 0;
    core::Deadline deadline;
  };

  /// Goes on from each start while that leads to better packings.  One start in four is a random
  /// packing; the others keep a part of the best packing found so far, in earlier runs too.  Calls
  /// found(arcs of the problem, ascending) with the best packing from each start.  Returns the work
  /// it took; 0 where there is nothing to search.
  /// Deterministic for a given state of `random`.
  double run(const Limits& limits,
             core::Random& random,
             const std::function<void(std::vector<std::uint32_t>)>& found);

 private:
  void start(core::Random& random);
  bool stopped(const Limits& limits) const;
  bool step(core::Random& random);
  std::uint32_t best_arrival(core::Random& random);
  std::uint32_t least_member() const;
  void remove(std::uint32_t n, std::uint64_t tenure);

  const Rivals& rivals_;
  GainPacking packing_;
  std::vector<double> closed_;  // in whole blocks: -inf for those that may not come back, else 0
  std::vector<double> block_most_;
  std::vector<std::uint32_t> tabu_;  // those that may not come back
  std::vector<std::uint64_t> tabu_until_;
  // The search from one start.
  std::uint64_t time_ = 0;
  double best_total_ = 0;
  std::vector<std::uint32_t> best_members_;
  // The best packing found.
  std::vector<std::uint32_t> elite_;
  double elite_total_ = 0;
  std::size_t num_starts_ = 0;
  double work_ = 0;
};

}  // namespace nda::recovery
