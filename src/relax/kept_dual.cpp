#include "relax/kept_dual.hpp"

#include <algorithm>
#include <cmath>

#include "decompose/components.hpp"

// The collapse leaves an m-dimensional problem of the same kind: a cell with two or more real
// indices is an arc, one with a single real index that index's singleton.  A cost shift makes the
// singletons free, and the problem is a Component, which whoever solves components can solve. Which
// cells there are does not depend on the multipliers, so it is split once for all (report, 4.7).

namespace nda::relax {
namespace {

using core::ArcId;
using core::Component;

constexpr std::uint32_t kNoCell = ~std::uint32_t{0};

}  // namespace

KeptDual::KeptDual(const Component& component, const KeptSets& kept)
    : RelaxedDual(component, std::min(kept.num_kept, component.num_dimensions() - 1)),
      kept_(kept),
      singleton_cell_(first_slot(), kNoCell),
      singleton_(first_slot(), 0.0),
      covered_(first_slot(), false) {
  find_parts(kept.decompose);
}

void KeptDual::find_parts(bool decompose) {
  const auto num_kept = static_cast<std::ptrdiff_t>(this->num_kept());
  if (num_kept == 0) return;
  const std::vector<Index>& sizes = component().sizes;
  Component whole = core::make_component({sizes.begin(), sizes.begin() + num_kept});
  std::vector<std::uint32_t> cell_of;  // [arc of the whole]
  std::vector<Index> tuple(static_cast<std::size_t>(num_kept));
  for (std::uint32_t cell = 0; cell < cells().num_cells(); ++cell) {
    std::vector<std::uint32_t> slots;
    for (int k = 0; k < num_kept; ++k) {
      const Index i = tuple[static_cast<std::size_t>(k)] =
          component().index(k, cells().first_arc[cell]);
      if (i != 0) slots.push_back(whole.offset[static_cast<std::size_t>(k)] + i);
    }
    if (slots.size() == 1) {
      singleton_cell_[slots.front()] = cell;
    } else {
      core::append_arc(whole, tuple, 0);
      cell_of.push_back(cell);
    }
  }
  if (cell_of.empty()) return;
  decompose::Partition partition = decompose::partition(whole);
  if (!decompose) decompose::join(partition);
  core::Cutter cutter;
  for (std::size_t c = 0; c < partition.num_components(); ++c) {
    Part& part = parts_.emplace_back();
    part.problem = cutter.cut(whole, partition.component(c));
    for (const ArcId a : part.problem.arc_origin) part.cells.push_back(cell_of[a]);
    part.problem.arc_origin.clear();
    part.slots = core::slots_in_part(whole, part.problem);
  }
}

RelaxedDual::KeptValue KeptDual::solve_kept(std::span<const double> costs,
                                            std::vector<std::uint32_t>& chosen) {
  KeptValue result;
  result.value = result.lower = pay_singletons(costs);
  std::fill(covered_.begin(), covered_.end(), false);
  for (Part& part : parts_) {
    solve(part, costs, chosen);
    const KeptAnswer& answer = part.answer;
    const bool bounded = answer.lower > -kInfinity;
    result.value += bounded && kept_.merit && !answer.exact ? answer.lower : answer.best.cost;
    result.lower += answer.lower;
    result.interrupted = result.interrupted || !bounded;
  }
  for (std::uint32_t slot = 0; slot < singleton_.size(); ++slot) {
    if (!covered_[slot] && singleton_[slot] < 0) chosen.push_back(singleton_cell_[slot]);
  }
  return result;
}

double KeptDual::pay_singletons(std::span<const double> costs) {
  double sum = 0;
  for (std::uint32_t slot = 0; slot < singleton_.size(); ++slot) {
    if (singleton_cell_[slot] == kNoCell) continue;
    singleton_[slot] = std::min(0.0, costs[singleton_cell_[slot]]);
    sum += singleton_[slot];
  }
  return sum;
}

void KeptDual::solve(Part& part,
                     std::span<const double> costs,
                     std::vector<std::uint32_t>& chosen) {
  const auto visit_slots = [&](std::uint32_t cell, auto&& visit) {
    const ArcId first = cells().first_arc[cell];
    for (int k = 0; k < num_kept(); ++k) visit(component().slot(k, first));
  };
  for (ArcId a = 0; a < part.problem.num_arcs(); ++a) {
    double& cost = part.problem.costs[a] = costs[part.cells[a]];
    visit_slots(part.cells[a], [&](std::uint32_t slot) { cost -= singleton_[slot]; });
  }
  kept_.solve(part.problem, part.answer);
  for (const ArcId a : part.answer.best.arcs) {
    chosen.push_back(part.cells[a]);
    visit_slots(part.cells[a], [&](std::uint32_t slot) { covered_[slot] = true; });
  }
}

void KeptDual::kept_multipliers(std::span<double> all) const {
  std::copy(singleton_.begin(), singleton_.end(), all.begin());
  for (const Part& part : parts_) {
    if (part.answer.u.empty()) continue;
    for (std::uint32_t slot = 0; slot < part.slots.size(); ++slot) {
      if (part.slots[slot] != 0) all[slot] += part.answer.u[part.slots[slot]];
    }
  }
}

std::int64_t KeptDual::evaluations() const {
  std::int64_t sum = 0;
  for (const Part& part : parts_) sum += part.answer.evaluations;
  return sum;
}

std::int64_t KeptDual::nodes() const {
  std::int64_t sum = 0;
  for (const Part& part : parts_) sum += part.answer.nodes;
  return sum;
}

}  // namespace nda::relax
