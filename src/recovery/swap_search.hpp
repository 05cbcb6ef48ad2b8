#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bnb/slack_search.hpp"
#include "core/clock.hpp"
#include "core/lists.hpp"
#include "core/random.hpp"

namespace nda::recovery {

/// Tabu search over the packings of a slack problem by swaps (Wu, Hao & Glover 2012): the arc that
/// gains most comes in, what excludes it leaves and may not come back for a while.
///
/// Takes the kMostArcs arcs of least reduced cost that save anything and stores which exclude each
/// other, up to 4 MB.
class SwapSearch {
 public:
  static constexpr std::size_t kMostArcs = 1000;

  /// Keeps a reference to the problem.  Prices must be finite.
  explicit SwapSearch(const bnb::SlackProblem& problem);

  struct Limits {
    double max_work = 0;  ///< in the units of bnb::SlackLimits, some 3e8 a second
    std::size_t max_starts = 0;
    core::Deadline deadline;
  };

  /// Goes on from each start while that leads to better packings.  One start in four is a random
  /// packing; the others keep a part of the best packing found so far, in earlier runs too.  Calls
  /// found(arcs of the problem, ascending) with the best packing from each start.  Returns the work
  /// it took, that of making the search at first; 0 where there is nothing to search.
  /// Deterministic for a given state of `random`.
  double run(const Limits& limits,
             core::Random& random,
             const std::function<void(std::vector<std::uint32_t>)>& found);

 private:
  void list_rivals();
  void start(core::Random& random);
  void insert_if_free(std::uint32_t n);
  bool stopped(const Limits& limits) const;
  bool step(core::Random& random);
  std::uint32_t best_arrival(core::Random& random);
  std::uint32_t least_member() const;
  void insert(std::uint32_t n);
  void remove(std::uint32_t n, std::uint64_t tenure);
  std::vector<std::uint32_t> packing(std::span<const std::uint32_t> members) const;

  const bnb::SlackProblem& problem_;
  std::vector<std::uint32_t> arcs_;    // ascending; the others are numbers in this list
  std::vector<double> value_;          // > 0: prices of an arc's rows less its reduced cost
  core::Lists<std::uint32_t> rivals_;  // what excludes an arc
  // The packing.
  // In whole blocks.
  std::vector<double> gain_;    // value less those of the members that would have to leave
  std::vector<double> closed_;  // -inf for members and those that may not come back, else 0
  std::vector<double> block_most_;
  std::vector<char> is_member_;
  std::vector<std::uint32_t> members_;
  std::vector<std::uint32_t> place_;  // of a member in members_
  std::vector<std::uint32_t> tabu_;   // those that may not come back
  std::vector<std::uint64_t> tabu_until_;
  double total_ = 0;  // value of the members
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
