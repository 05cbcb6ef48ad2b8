#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nda/proof.hpp"

namespace nda::core {

/// What is wrong with a proof; thrown within the checker.
struct ProofFault {
  std::string text;
};

/// The arcs of a part with the positions of their indices.
struct PartArcs {
  std::vector<double> cost;
  std::vector<std::uint32_t> number;  ///< in the problem, from 1; ascending
  std::vector<std::uint32_t> start = {0};
  std::vector<std::uint32_t> positions;

  std::size_t size() const { return cost.size(); }
  template <typename Visit>
  void for_each_position(std::size_t a, Visit&& visit) const {
    for (std::uint32_t p = start[a]; p < start[a + 1]; ++p) visit(positions[p]);
  }
  bool uses(std::size_t a, std::uint32_t position) const {
    return std::find(positions.begin() + start[a], positions.begin() + start[a + 1], position) !=
           positions.begin() + start[a + 1];
  }
};

/// What the steps of a part show: a lower bound on every choice of its arcs and singletons that
/// uses each index exactly once.
/// @param singletons  by position; +inf = forbidden.
/// @param grid        all costs are multiples of it but for one rounding; 0 = not known.
/// Throws ProofFault "step 3: ..." where they are no tree.
double part_bound(const PartArcs& arcs,
                  const std::vector<double>& singletons,
                  double grid,
                  const std::vector<ProofStep>& steps);

}  // namespace nda::core
