#include "reduce/small_packing.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

// Packings by enumeration: arc by arc, in or out.  Multipliers by coordinate ascent on the
// separable dual: every one is put half way between the two cheapest uses of its index, leaving it
// alone being one; at the end each is raised as far as it goes, which also repairs what is
// negative. Ascent can stall below the optimum; then the sum misses the cost of the packing.

namespace nda::reduce {
namespace {

using core::ArcId;

constexpr int kMostSteps = 20000;
constexpr int kSweeps = 30;
// A sum of that many terms may miss by rounding: this share of its size.
constexpr double kRounding = 0x1p-46;

}  // namespace

SmallPacking::SmallPacking(const ArcPool& pool, std::span<const ArcId> arcs)
    : arcs_(arcs), rows_(arcs.size()) {
  for (const ArcId a : arcs) {
    const auto own = pool.slots(a);
    slots_.insert(slots_.end(), own.begin(), own.end());
    cost_.push_back(pool.cost(a));
  }
  std::sort(slots_.begin(), slots_.end());
  slots_.erase(std::unique(slots_.begin(), slots_.end()), slots_.end());
  arcs_at_.resize(slots_.size());
  for (std::size_t n = 0; n < arcs.size(); ++n) {
    for (const std::uint32_t slot : pool.slots(arcs[n])) {
      rows_[n].push_back(row_of(slot));
      arcs_at_[rows_[n].back()].push_back(n);
    }
  }
  used_.assign(slots_.size() + 1, 0);
}

std::size_t SmallPacking::row_of(std::uint32_t slot) const {
  return static_cast<std::size_t>(std::lower_bound(slots_.begin(), slots_.end(), slot) -
                                  slots_.begin());
}

bool SmallPacking::solve(std::uint32_t gate) {
  const bool is_used = std::binary_search(slots_.begin(), slots_.end(), gate);
  gate_row_ = is_used ? row_of(gate) : slots_.size();
  return enumerate(0) && find_multipliers();
}

void SmallPacking::note_packing() {
  if (current_.cost < best_.cost) best_ = current_;
  if (!used_[gate_row_] && current_.cost < best_without_.cost) best_without_ = current_;
}

// False where that takes too many steps.
bool SmallPacking::enumerate(std::size_t next) {
  if (++steps_ > kMostSteps) return false;
  if (next == arcs_.size()) {
    note_packing();
    return true;
  }
  const std::vector<std::size_t>& rows = rows_[next];
  if (std::none_of(rows.begin(), rows.end(), [&](std::size_t row) { return used_[row] != 0; })) {
    const double before = current_.cost;
    for (const std::size_t row : rows) used_[row] = 1;
    current_.arcs.push_back(arcs_[next]);
    current_.cost += cost_[next];
    const bool done = enumerate(next + 1);
    for (const std::size_t row : rows) used_[row] = 0;
    current_.arcs.pop_back();
    current_.cost = before;
    if (!done) return false;
  }
  return enumerate(next + 1);
}

double SmallPacking::reduced(std::size_t n) const {
  double r = cost_[n];
  for (const std::size_t row : rows_[n]) r -= row == gate_row_ ? gate_price_ : multipliers_[row];
  return r;
}

// Half way between the two cheapest uses of the index.
void SmallPacking::halve(std::size_t row) {
  double best = 0;
  double second = kInfinity;
  for (const std::size_t n : arcs_at_[row]) {
    const double use = reduced(n) + multipliers_[row];
    second = std::min(second, std::max(best, use));
    best = std::min(best, use);
  }
  multipliers_[row] = std::min(0.0, (best + second) / 2);
}

// As high as its arcs allow.
void SmallPacking::tighten(std::size_t row) {
  double least = kInfinity;
  for (const std::size_t n : arcs_at_[row]) least = std::min(least, reduced(n));
  multipliers_[row] = std::min(0.0, multipliers_[row] + least);
}

bool SmallPacking::find_multipliers() {
  multipliers_.assign(slots_.size(), 0.0);
  gate_price_ = best_.cost - best_without_.cost;
  const auto sweep = [&](void (SmallPacking::*step)(std::size_t)) {
    for (std::size_t row = 0; row < slots_.size(); ++row) {
      if (row != gate_row_) (this->*step)(row);
    }
  };
  for (int n = 0; n < kSweeps; ++n) sweep(&SmallPacking::halve);
  sweep(&SmallPacking::tighten);
  double size = 0;
  for (std::size_t n = 0; n < arcs_.size(); ++n) {
    size += std::abs(cost_[n]);
    // Arcs that use the gate alone are not repaired.
    if (reduced(n) < -kRounding * std::abs(cost_[n])) return false;
  }
  const double sum = std::accumulate(multipliers_.begin(), multipliers_.end(), 0.0);
  return sum >= best_without_.cost - kRounding * size;
}

}  // namespace nda::reduce
