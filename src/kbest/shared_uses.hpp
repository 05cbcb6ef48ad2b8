#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/double_double.hpp"
#include "kbest/index_numbers.hpp"
#include "nda/marginals.hpp"
#include "nda/solution.hpp"

namespace nda::kbest {

/// What a list of solutions does with *shared* indices, those that any of the solutions uses in
/// several arcs, as bounds on uses allow.  A use is the set of an index's arcs in a solution.
class SharedUses {
 public:
  /// @param shared  by index number.
  /// @param arcs    all of the solutions, lexicographic.
  /// Cost: O(arcs of all solutions (N + log arcs)), and per solution the pairs of its arcs that
  /// have two shared indices or more.
  SharedUses(const IndexNumbers& numbers,
             const std::vector<bool>& shared,
             std::span<const RankedSolution> ranks,
             std::span<const double> weights,
             std::span<const ArcMarginal> arcs);

  /// Of the solutions that leave a shared index alone.
  double alone(std::size_t index) const;
  /// Of every use of a shared index, being alone among them.
  std::vector<double> weights(std::size_t index) const;
  /// By how much the arcs that have both indices weigh more than the solutions that have such arcs.
  core::DoubleDouble excess(std::size_t first, std::size_t second) const;

 private:
  using Use = std::vector<std::size_t>;  // positions of arcs, ascending

  void add_pairs(const IndexNumbers& numbers,
                 const std::map<std::size_t, Use>& uses,
                 std::span<const ArcMarginal> arcs,
                 double weight);

  std::map<std::size_t, std::map<Use, core::DoubleDouble>> uses_;
  std::map<std::pair<std::size_t, std::size_t>, core::DoubleDouble> excess_;
};

}  // namespace nda::kbest
