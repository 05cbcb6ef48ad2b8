#include "relax/relaxed_dual.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/min_max.hpp"
#include "core/reduced_costs.hpp"

// Report, sections 3.1 and 4.1, with three liberties.
//   - The problem is shifted, so that every index may stay uncovered at cost 0: a cell with one
//   real kept
//     index is what that index costs when it stays out of all other cells.
//   - Singletons of relaxed indices are relaxed with everything else; eq. (3.3) puts them into
//   c(0..0).  Their
//     part is closed: min(0, 0 - u_i) + u_i = min(0, u_i).  u needs no sign and no box.
//   - At u_i = 0 the singleton is indifferent; we use it exactly when no arc uses i, which gives
//   the subgradient
//     nearest to zero among its choices.

namespace nda::relax {

using core::ArcId;
using core::Component;

RelaxedDual::RelaxedDual(const Component& component, int num_kept)
    : component_(component),
      cells_(find_cells(component, num_kept)),
      slot_u_(component.num_slots(), 0.0),
      d_(cells_.num_cells()),
      cell_from_(cells_.are_short() ? 0 : cells_.num_cells()) {
  const auto kept = static_cast<std::size_t>(num_kept);
  first_slot_ = kept < component.sizes.size() ? component.offset[kept]
                                              : static_cast<std::uint32_t>(component.num_slots());
  largest_cost_ = core::largest_cost(component);
}

double RelaxedDual::evaluate(std::span<const double> u, std::span<double> subgradient) {
  std::copy(u.begin(), u.end(), slot_u_.begin() + first_slot_);
  collapse(component_, cells_, slot_u_, d_, cell_from_);
  chosen_.clear();
  aligned_cells_.clear();
  const KeptValue kept = solve_kept(d_, aligned_cells_);
  interrupted_ = kept.interrupted;
  kept_gap_ = kept.value - kept.lower;

  double value = kept.value;
  for (const double multiplier : u) value += std::min(0.0, multiplier);
  std::fill(subgradient.begin(), subgradient.end(), 0.0);
  CheapestArcs arcs(component_, cells_, slot_u_, d_, cell_from_, aligned_cells_);
  while (!arcs.done()) use(arcs.next(), subgradient);
  value += take_free_arcs(subgradient);
  for (std::size_t j = 0; j < u.size(); ++j) {
    const double uses = -subgradient[j];
    const double singleton = u[j] > 0 || (u[j] == 0 && uses == 0) ? 1.0 : 0.0;
    subgradient[j] = 1.0 - uses - singleton;
  }
  for (std::size_t k = static_cast<std::size_t>(num_kept()); k < component_.sizes.size(); ++k) {
    subgradient[component_.offset[k] - first_slot_] = 0.0;
  }
  violation_ = std::inner_product(subgradient.begin(), subgradient.end(), subgradient.begin(), 0.0);
  return value_ = value;
}

// All terms of the value are <= 0, so each of its T additions errs by at most 2^-53 |value|.  No
// partial sum of a reduced cost exceeds L = largest |c'| + N largest |u|, so cells err by N 2^-53
// L, and by as much again where a shift makes their singletons free; a sparse assignment takes
// former mates within 2^-50 of prices, which are no more than L; a packing has no more cells than
// kept indices, and there are the arcs chosen from cell (0 .. 0).  Twice all that.
double RelaxedDual::bound() const {
  double largest_u = 0;
  for (const double multiplier : slot_u_) largest_u = std::max(largest_u, std::abs(multiplier));
  const auto dimensions = static_cast<double>(component_.num_dimensions());
  const double terms = static_cast<double>(first_slot_ + chosen_.size() + 4);
  const double additions = terms + static_cast<double>(num_variables());
  const double term_error =
      (dimensions + 2) * (dimensions + 2) * (largest_cost_ + dimensions * largest_u);
  const double error = 0x1p-52 * (additions * std::abs(value_) + terms * term_error);
  return value_ - kept_gap_ - error;
}

// Those of cell (0 .. 0).
double RelaxedDual::take_free_arcs(std::span<double> subgradient) {
  std::array<double, core::kReducedBlock> r;
  double value = 0;
  for (ArcId first = 0; first < cells_.num_free();) {
    const std::size_t count = std::min<std::size_t>(r.size(), cells_.num_free() - first);
    core::reduced_costs(component_, slot_u_, first, std::span(r).first(count), num_kept());
    for (std::size_t n = 0; n < count; ++n) {
      if (r[n] >= 0) continue;
      value += r[n];
      use(first + static_cast<ArcId>(n), subgradient);
    }
    first += static_cast<ArcId>(count);
  }
  return value;
}

void RelaxedDual::use(ArcId a, std::span<double> subgradient) {
  chosen_.push_back(a);
  for (int k = num_kept(); k < component_.num_dimensions(); ++k) {
    subgradient[component_.slot(k, a) - first_slot_] -= 1.0;
  }
}

void RelaxedDual::multipliers(std::span<double> all) const {
  kept_multipliers(all);
  for (std::size_t slot = first_slot_; slot < slot_u_.size(); ++slot) {
    all[slot] = std::min(0.0, slot_u_[slot]);
  }
  for (const std::uint32_t dummy : component_.offset) all[dummy] = 0.0;
}

// Reduced costs are computed again for every dimension rather than kept: that costs no more time
// than reading and writing them, and no memory.
double make_feasible(const Component& component,
                     std::span<double> u,
                     const core::Deadline& deadline) {
  std::vector<double> least_of;
  for (std::size_t k = component.sizes.size(); k-- > 0;) {
    const Index* index = component.indices[k].data();
    const std::span<double> block = u.subspan(component.offset[k], component.sizes[k] + 1);
    least_of.assign(block.size(), kInfinity);
    const std::span<double> least(least_of);
    const auto note = [least, index](ArcId a, double r) {
      least[index[a]] = core::min_of(least[index[a]], r);
    };
    if (!core::for_each_reduced_cost(component, u, deadline, note)) return -kInfinity;
    for (std::size_t i = 1; i < block.size(); ++i) block[i] = std::min(0.0, block[i] + least[i]);
  }
  double sum = 0;
  for (const double multiplier : u) sum += multiplier;
  return sum;
}

}  // namespace nda::relax
