#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "nda/types.hpp"

namespace nda {

struct RankedSolution;
struct Solution;

/// How costs are read as likelihoods.
struct MarginalOptions {
  /// What a solution costs more when it is e times less likely; finite, above 0.  1 where costs are
  /// negative log-likelihood ratios; 2 where they are squared Mahalanobis distances with their
  /// log-determinants (-2 log L); 1000 where such ratios were rounded to whole thousandths.
  double cost_per_nat = 1;
};

/// An arc of at least one of the solutions.
struct ArcMarginal {
  std::vector<Index> arc;  ///< N entries
  double weight = 0;       ///< of the solutions that use it
};

/// Two real indices that at least one of the solutions puts into one arc, or several; dimensions
/// from 0, the first below the second.
struct PairMarginal {
  int first_dimension = 0;
  Index first = 0;
  int second_dimension = 0;
  Index second = 0;
  double weight = 0;  ///< of the solutions that do
};

/// An index that not all of the solutions use alike.  A use is the set of its arcs in a solution:
/// none, one, or several where bounds on uses allow it.
struct AmbiguousIndex {
  int dimension = 0;  ///< from 0
  Index index = 0;
  /// Of its uses, -sum w ln w, in nats: 0 = as good as certain, ln m = m uses of equal weight.
  double entropy = 0;
  std::vector<std::size_t> arcs;  ///< of any use: positions in Marginals::arcs, of falling weight
};

/// What the solutions of a list say together, each counting by its likelihood:
///
///     weight of rank r = exp(-(cost_r - least cost) / cost_per_nat) / sum of these over all ranks,
///     weight of anything else = sum of the weights of the ranks that have it.
///
/// These are posteriors *given that the truth is one of the ranks*.  What lies beyond the last rank
/// has a weight that is not known in general: every solution there may cost little more than the
/// last rank, and how many there are is not counted.  So the weight of a rank is at least its
/// posterior among all solutions, that of an arc, pair or index may err to either side.  They are
/// exact where the list holds every solution (Solution::lists_all).
///
/// Ranks that are not proven count too, as they are solutions like others; but solutions that are
/// as good may be missing beside them, so read num_proven first.
///
/// The weights of an index's arcs and `alone` add up to 1 to 1e-12, as do those of the ranks; what
/// all ranks have weighs exactly 1.  Where a rank uses an index in several arcs (UseBounds), these
/// add up to more, as each counts by itself; those of its uses still make 1.
struct Marginals {
  double cost_per_nat = 1;                 ///< the option
  std::size_t num_proven = 0;              ///< how many of the first ranks are proven
  std::vector<double> weights;             ///< of each rank
  std::vector<ArcMarginal> arcs;           ///< lexicographic
  std::vector<PairMarginal> pairs;         ///< by first_dimension, first, second_dimension, second
  std::vector<std::vector<double>> alone;  ///< [k][i-1]: of the ranks that leave i of k alone
  /// Greatest entropy first; where equal by dimension, then index.
  std::vector<AmbiguousIndex> ambiguous;
};

/// The marginals of a solution's list; see solve_k_best().  Of one rank everything is certain;
/// without any, all lists are empty.
///
/// Costs count as they are stated: of equal ones each has the same weight, infinite ones too, and
/// what is e^-745 times as likely as the best weighs 0.  A solution that is listed twice counts
/// twice.
///
/// Throws InputError for an option out of range, a cost that is not a number, and arcs that are not
/// those of a solution: N entries within the sizes, lexicographic, none twice.  Whether an index
/// may be used as often as it is, is for check() to say. Cost: O(arcs of all solutions N), and
/// O(N^2) for each arc that any of them has; a factor log more for indices that are used twice.
/// Thread safe.
Marginals marginals(const Solution& solution, const MarginalOptions& options = {});

/// The same of a list of one's own.  @param sizes  M_k of the problem.
Marginals marginals(std::span<const Index> sizes,
                    std::span<const RankedSolution> ranks,
                    const MarginalOptions& options = {});

}  // namespace nda
