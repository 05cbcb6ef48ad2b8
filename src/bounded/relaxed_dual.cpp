#include "bounded/relaxed_dual.hpp"

#include <algorithm>
#include <cmath>

namespace nda::bounded {

using core::ArcId;

RelaxedDual::RelaxedDual(const BoundedComponent& component, int num_kept)
    : component_(component),
      cells_(find_cells(component.graph, std::min(num_kept, component.graph.num_dimensions()))),
      slot_u_(component.rows.size(), 0.0),
      r_(component.num_arcs()) {
  const auto kept = static_cast<std::size_t>(cells_.num_kept);
  first_slot_ = kept < component.graph.sizes.size()
                    ? component.graph.offset[kept]
                    : static_cast<std::uint32_t>(component.rows.size());
}

double RelaxedDual::evaluate(std::span<const double> u, std::span<double> subgradient) {
  std::copy(u.begin(), u.end(), slot_u_.begin() + first_slot_);
  for (ArcId a = 0; a < r_.size(); ++a) r_[a] = core::reduced_cost(component_.graph, slot_u_, a);
  chosen_.clear();
  collapse();
  const KeptValue kept = solve_kept(offered_, chosen_);
  kept_gap_ = kept.value - kept.lower;
  value_ = kept.value + take_free_arcs();
  std::sort(chosen_.begin(), chosen_.end());
  const std::vector<Index> uses = count_uses(component_.graph, chosen_);
  for (std::size_t j = 0; j < u.size(); ++j) {
    const std::size_t slot = first_slot_ + j;
    const Row& row = component_.rows[slot];
    value_ += row.value(u[j]);
    subgradient[j] = static_cast<double>(row.best_uses(u[j], uses[slot])) - uses[slot];
  }
  return value_;
}

// An arc that costs no less than its kept indices lack without it is of no use.
void RelaxedDual::collapse() {
  offered_.clear();
  for (std::size_t cell = cells_.num_free; cell < cells_.num_cells(); ++cell) {
    of_cell_.assign(cells_[cell].begin(), cells_[cell].end());
    const ArcId any = of_cell_.front();
    double worth = 0;
    for (int k = 0; k < num_kept(); ++k) {
      const Row& row = component_.rows[component_.graph.slot(k, any)];
      if (row.lo > 0) worth += row.single;
    }
    const auto most =
        std::min<std::size_t>(most_uses_of_cell(component_, num_kept(), any), of_cell_.size());
    const auto end = of_cell_.begin() + static_cast<std::ptrdiff_t>(most);
    if (end != of_cell_.end()) {
      std::nth_element(of_cell_.begin(), end, of_cell_.end(), [&](ArcId a, ArcId b) {
        return r_[a] != r_[b] ? r_[a] < r_[b] : a < b;
      });
    }
    std::copy_if(of_cell_.begin(), end, std::back_inserter(offered_), [&](ArcId a) {
      return r_[a] < worth;
    });
  }
}

// Those of cell (0 .. 0) that pay.
double RelaxedDual::take_free_arcs() {
  double value = 0;
  if (cells_.num_free == 0) return value;
  for (const ArcId a : cells_[0]) {
    if (r_[a] >= 0) continue;
    value += r_[a];
    chosen_.push_back(a);
  }
  return value;
}

double RelaxedDual::kept_cost(std::span<const ArcId> arcs) const {
  double cost = 0;
  for (const ArcId a : arcs) cost += r_[a];
  const std::vector<Index> uses = count_uses(component_.graph, arcs);
  for (std::size_t slot = 0; slot < first_slot_; ++slot)
    cost += component_.rows[slot].cost(uses[slot]);
  return cost;
}

// Each reduced cost errs by N ulps of the largest partial sum, and no more of them are added than
// kept indices have uses and cell (0 .. 0) arcs; the sum itself by an ulp of the sizes of its terms
// for each.
double RelaxedDual::bound() const {
  const double largest = core::largest_cost(component_.graph);
  double size = std::abs(value_) + std::abs(kept_gap_);
  double terms = static_cast<double>(component_.rows.size() + r_.size());
  double largest_u = 0;
  for (std::size_t slot = 0; slot < slot_u_.size(); ++slot) {
    const Row& row = component_.rows[slot];
    largest_u = std::max(largest_u, std::abs(slot_u_[slot]));
    size += row.hi * (std::abs(row.single) + std::abs(slot_u_[slot]));
    if (slot < first_slot_) terms += row.hi;
  }
  const double dimensions = component_.graph.num_dimensions();
  const double arc_size = (dimensions + 2) * (largest + dimensions * largest_u);
  return value_ - kept_gap_ - 0x1p-51 * terms * (size + arc_size);
}

}  // namespace nda::bounded
