#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "nda/options.hpp"
#include "nda/problem.hpp"
#include "nda/solution.hpp"

namespace nda {

/// The k best solutions of an N-dimensional assignment problem: as solve(), with up to k entries in
/// Solution::solutions, best first, all different.  Solutions of equal cost come in any order.
///
/// `proven` of an entry says that no other choice of so many solutions is better: the costs of the
/// proven entries are those of the best ones there are.  Solution::lists_all says that there are no
/// others.  Where the optimum is not proven, or a limit strikes while ranking, the best of the
/// solutions at hand follow without proof: those that differ from the first by one arc, or by two;
/// one of them may be better and come first.  Status, bound and everything else are
/// about the first, but for the time and the nodes.
///
/// Whoever asks for more than there are gets all; where these are too many for memory only a limit
/// ends it in time.  A limit that stops ranking leaves status `optimal`, which is about the first;
/// num_proven() tells, and `nda solve` ends with exit code 3.
///
/// Options::ranking chooses other ways than this: good solutions without a proof of their ranks,
/// by partial branch and bound (docs/partial_branch_and_bound.md).
///
/// With bounds on uses (docs/many_to_one.md) solutions differ by their arcs: how often singletons
/// are chosen follows from these.  A limit that strikes while ranking leaves those ranks proven
/// that the bounds of what was not searched prove.
///
/// Throws InputError for k = 0, for ways other than RankingMethod::kExact where an index has bounds
/// on its uses, and where solve() does.  Cost: one solve(), then O(A N) and a search that is short
/// where the optimum has little slack; exponential in the worst case.  Memory: about a hundred
/// bytes for every arc of every rank, most of them in the answer (docs/k_best.md).  Thread safe.
Solution solve_k_best(const Problem& problem, std::size_t k, const Options& options = {});

/// How many of the first solutions are proven.
std::size_t num_proven(const Solution& solution);

/// The solutions of a problem one after the other, best first, for whoever does not know how many
/// it takes:
///
///     nda::Ranking ranking(problem);
///     for (nda::RankedSolution next; ranking.next(next) && wanted(next);) use(next);
///
/// They are those of solve_k_best(), of equal cost maybe in another order.  What was found is not
/// searched again (but with bounds on uses, where as many again are found at once), and a few are
/// found in advance: most calls only hand out the next one.
///
/// | status()             | next() gave nothing because                                     |
/// |----------------------|-----------------------------------------------------------------|
/// | optimal              | there are no others                                             |
/// | infeasible           | there is none at all                                            |
/// | time_limit           | a limit struck: what it gave stays proven, and the next call    |
/// | node_limit           | goes on where this one stopped, with limits of its own; only    |
/// | interrupted          | a solve() that is not done begins anew                          |
/// | gap_reached, iteration_limit, precision_lost | the best and its neighbours, which it gave |
/// |                      | without proof, are all that these leave; one may be better      |
///
/// Always exact: Options::ranking counts for solve_k_best() only.
///
/// Copies nothing: the problem must outlive it, unchanged.  One thread at a time; different ones
/// may share a problem.
class Ranking {
 public:
  /// Solves nothing yet.  Throws InputError where an option is out of range.
  explicit Ranking(const Problem& problem, const Options& options = {});
  explicit Ranking(Problem&& problem, const Options& options = {}) = delete;
  Ranking(Ranking&& other) noexcept;
  Ranking& operator=(Ranking&& other) noexcept;
  ~Ranking();

  /// The next best solution, the first call the best; false if it gives none, and `solution` stays
  /// as it was.  Limits, callback and request to stop are those of the options of the constructor,
  /// anew for every call.  Of an object that was moved from: false.
  bool next(RankedSolution& solution);

  /// The same with these options for this call.  All but limits, callback and request to stop
  /// counts only until the best solution is known.  Throws InputError where one is out of range.
  bool next(RankedSolution& solution, const Options& options);

  /// Of the last next(): "optimal" where it gave a proven solution; see above where it gave none.
  /// Before the first: interrupted.
  Status status() const;

  /// What solve() came to, its `solutions` with the best alone; time and nodes go on.  Empty before
  /// the first next().
  const Solution& solution() const;

  /// The best solutions at hand that next() did not give, without proof, at most so many: for
  /// whoever cannot wait when a limit struck.  They may come again, proven.
  std::vector<RankedSolution> at_hand(std::size_t count) const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace nda
