#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "nda/options.hpp"
#include "recovery/recovery_problem.hpp"
#include "relax/alignment.hpp"
#include "relax/collapse.hpp"

namespace nda::kbest {

/// Partial branch and bound over index alignments: good packings of a component, without proof.
///
/// Every step of nonsmooth optimisation gives an alignment of the first two dimensions; the best of
/// them, at most options.ranking.branches, are followed.  A branch is its recovery problem, of one
/// dimension less, searched in the same way down to two dimensions; it is left out when the dual of
/// its inner problem shows that it has nothing for the solution buffer.  With
/// RankingMethod::kMurty the branches are the best two-dimensional assignments of the best
/// multipliers instead.
///
/// Source: the paper on partial branch and bound, sections 3.2 and 4.
class PartialBranchAndBound {
 public:
  /// @param k  how many packings are kept, at every stage.
  PartialBranchAndBound(const Options& options, std::size_t k, const core::Deadline& deadline)
      : options_(options), k_(k), deadline_(deadline) {}

  /// Up to k packings, best first, no two the same; none where the deadline strikes at once.
  ///
  /// @param warm  multipliers by slot, or empty.
  /// Cost: at most branches^(N - 2) assignments, and as many dual functions maximised.
  std::vector<core::Packing> rank(const core::Component& component, std::span<const double> warm);

  /// What was done so far.
  struct Work {
    std::int64_t evaluations = 0;  ///< of dual functions, but for inner problems
    std::int64_t branches = 0;     ///< alignments followed
    std::int64_t cut = 0;          ///< of these, left out by their bound
    std::int64_t leaves = 0;       ///< two-dimensional problems solved
  };
  const Work& work() const { return work_; }

 private:
  // A component whose dual function was maximised.
  struct Stage {
    const core::Component& component;
    relax::Cells cells;
  };

  std::vector<core::Packing> rank(const core::Component& component,
                                  std::span<const double> warm,
                                  int max_evaluations,
                                  double cutoff);
  std::vector<core::Packing> assign(const core::Component& component, double cutoff);
  std::vector<relax::Alignment> best_assignments(const core::Component& component,
                                                 const relax::Alignment& best) const;
  std::vector<core::Packing> follow(const Stage& stage,
                                    const relax::Alignment& alignment,
                                    double cutoff);

  const Options& options_;
  const std::size_t k_;
  const core::Deadline& deadline_;
  Work work_;
};

}  // namespace nda::kbest
