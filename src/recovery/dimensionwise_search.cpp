#include "recovery/dimensionwise_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/slices.hpp"
#include "recovery/packing_state.hpp"

// Among n parts a side a cut has n^2 pairs.  Where most tuples are arcs each of them is a real
// choice, and one move chooses among n! packings; where few are, hardly any pair but those of the
// packing is an arc, and nothing moves.  So this is for dense components alone.  The key of a tuple
// is the sum of the keys of its parts, a number in mixed radix, hence a pair is one addition and
// one look-up, and nothing else need be known of a part.
//
// An exact search of neighbourhoods sees through a dozen arcs of small reduced cost; a move sees
// all arcs of the component, and all of the packing at once.  On dense components it makes in
// well under a millisecond what a greedy or rounded packing needs thousands of ejections for.

namespace nda::recovery {

using core::ArcId;
using core::Component;

namespace {

constexpr double kWorkPerPair = 6;
constexpr double kBetter = 1e-9;
constexpr std::size_t kShuffled = 3;  // arcs

double num_tuples(const Component& component) {
  double tuples = 1;
  for (const Index size : component.sizes) tuples *= size + 1.0;
  return tuples;
}

bool is_column(std::uint32_t cut, int dimension) {
  return (cut >> dimension & 1) != 0;
}

}  // namespace

bool DimensionwiseSearch::suits(const Component& component) {
  const int dimensions = component.num_dimensions();
  return dimensions > 2 && dimensions <= kMostDimensions &&
         num_tuples(component) <= kMostTuplesPerArc * static_cast<double>(component.num_arcs());
}

DimensionwiseSearch::DimensionwiseSearch(const Component& component, const core::Deadline& deadline)
    : component_(component),
      deadline_(deadline),
      stop_([this] { return deadline_.reached(); }),
      stride_(component.num_slots(), 0) {
  std::uint64_t stride = 1;
  for (std::size_t k = component.sizes.size(); k-- > 0; stride *= component.sizes[k] + 1) {
    for (Index i = 1; i <= component.sizes[k]; ++i) stride_[component.offset[k] + i] = i * stride;
  }
  solver_.set_stop(&stop_);
  fill_table();
}

void DimensionwiseSearch::fill_table() {
  table_.assign(static_cast<std::size_t>(num_tuples(component_)), kNoArc);
  for (ArcId a = 0; a < component_.num_arcs(); ++a) {
    if (a % core::kSlice == 0 && deadline_.reached()) return;
    if (component_.costs[a] >= 0) continue;
    std::uint64_t key = 0;
    core::for_each_slot(component_, a, [&](std::uint32_t slot) { key += stride_[slot]; });
    table_[key] = a;
  }
}

double DimensionwiseSearch::cost_of(std::uint64_t key) const {
  const ArcId a = table_[key];
  return a == kNoArc ? kInfinity : component_.costs[a];
}

double DimensionwiseSearch::cost_of(const Arcs& arcs) const {
  double cost = 0;
  for (const ArcId a : arcs) cost += component_.costs[a];
  return cost;
}

void DimensionwiseSearch::add(std::uint64_t key, Arcs& arcs) const {
  if (table_[key] != kNoArc) arcs.push_back(table_[key]);
}

void DimensionwiseSearch::mark_covered(const Arcs& arcs) {
  is_covered_.assign(component_.num_slots(), 0);
  for (const ArcId a : arcs)
    core::for_each_slot(component_, a, [&](std::uint32_t slot) { is_covered_[slot] = 1; });
}

double DimensionwiseSearch::descend(core::Packing& packing) {
  work_ = 0;
  Arcs arcs = packing.arcs;
  fill(arcs);
  descend(arcs);
  core::Packing found = core::make_packing(component_, std::move(arcs));
  if (found.cost < packing.cost) packing = std::move(found);
  return work_;
}

double DimensionwiseSearch::improve(core::Packing& packing,
                                    double max_work,
                                    double goal,
                                    core::Random& random) {
  descend(packing);
  while (work_ < max_work && packing.cost > goal && !packing.arcs.empty() && !deadline_.reached()) {
    Arcs arcs = packing.arcs;
    shuffle(arcs, random);
    fill(arcs);
    descend(arcs);
    // Equal ones let the search drift.
    if (cost_of(arcs) <= packing.cost) packing = core::make_packing(component_, std::move(arcs));
  }
  return work_;
}

// The n-th uncovered indices of all dimensions make a tuple.
void DimensionwiseSearch::fill(Arcs& arcs) {
  mark_covered(arcs);
  std::vector<std::uint64_t> keys(component_.num_slots(), 0);
  std::size_t count = keys.size();
  for (std::size_t k = 0; k < component_.sizes.size(); ++k) {
    std::size_t n = 0;
    for (Index i = 1; i <= component_.sizes[k]; ++i) {
      const std::uint32_t slot = component_.offset[k] + i;
      if (is_covered_[slot] == 0) keys[n++] += stride_[slot];
    }
    count = std::min(count, n);
  }
  for (std::size_t n = 0; n < count; ++n) add(keys[n], arcs);
}

void DimensionwiseSearch::descend(Arcs& arcs) {
  const std::uint32_t num_cuts = (1u << (component_.num_dimensions() - 1)) - 1;
  std::uint32_t in_vain = 0;
  for (std::uint32_t n = 0; in_vain < num_cuts && !deadline_.reached(); ++n) {
    // Dimension 0 belongs to the rows.
    const std::uint32_t cut = (1 + n % num_cuts) << 1;
    // A part left alone that is no arc falls apart: the same cut may improve again.
    in_vain = reassign(cut, arcs) ? 0 : in_vain + 1;
  }
}

bool DimensionwiseSearch::reassign(std::uint32_t cut, Arcs& arcs) {
  list_parts(cut, arcs);
  list_costs();
  try {
    solver_.solve_matrix({cost_, row_outside_, column_outside_}, assignment_);
  } catch (const Assign2dInterrupted&) {
    return false;
  }
  const double before = cost_of(arcs);
  if (!(assignment_.cost < before - kBetter * std::abs(before))) return false;
  join(arcs);
  return true;
}

void DimensionwiseSearch::list_parts(std::uint32_t cut, const Arcs& arcs) {
  rows_.clear();
  columns_.clear();
  for (const ArcId a : arcs) {
    std::uint64_t row = 0;
    std::uint64_t column = 0;
    for (int k = 0; k < component_.num_dimensions(); ++k)
      (is_column(cut, k) ? column : row) += stride_[component_.slot(k, a)];
    if (row != 0) rows_.push_back(row);
    if (column != 0) columns_.push_back(column);
  }
  mark_covered(arcs);
  for (int k = 0; k < component_.num_dimensions(); ++k) {
    std::vector<std::uint64_t>& parts = is_column(cut, k) ? columns_ : rows_;
    const std::uint32_t dummy = component_.offset[static_cast<std::size_t>(k)];
    const Index size = component_.sizes[static_cast<std::size_t>(k)];
    for (std::uint32_t slot = dummy + 1; slot <= dummy + size; ++slot) {
      if (is_covered_[slot] == 0) parts.push_back(stride_[slot]);
    }
  }
}

// A part that is an arc may stay alone for what that saves, any other for nothing.
void DimensionwiseSearch::list_costs() {
  const auto outside = [&](std::uint64_t part) { return std::min(0.0, cost_of(part)); };
  row_outside_.resize(rows_.size());
  column_outside_.resize(columns_.size());
  std::transform(rows_.begin(), rows_.end(), row_outside_.begin(), outside);
  std::transform(columns_.begin(), columns_.end(), column_outside_.begin(), outside);
  cost_.clear();
  for (const std::uint64_t row : rows_) {
    for (const std::uint64_t column : columns_) cost_.push_back(cost_of(row + column));
  }
  work_ += kWorkPerPair * static_cast<double>(cost_.size() + component_.num_slots());
}

void DimensionwiseSearch::join(Arcs& arcs) const {
  arcs.clear();
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const std::int32_t c = assignment_.column_of_row[r];
    add(c == kUnassigned ? rows_[r] : rows_[r] + columns_[static_cast<std::size_t>(c)], arcs);
  }
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (assignment_.row_of_column[c] == kUnassigned) add(columns_[c], arcs);
  }
}

// A few arcs exchange their indices at random; what is no arc then is left uncovered.
void DimensionwiseSearch::shuffle(Arcs& arcs, core::Random& random) const {
  const std::size_t count = std::min(kShuffled, arcs.size());
  for (std::size_t n = 0; n < count; ++n)
    std::swap(arcs[n], arcs[n + random.below(arcs.size() - n)]);
  std::vector<std::uint64_t> keys(count, 0);
  std::vector<std::uint64_t> shares(count);
  for (int k = 0; k < component_.num_dimensions(); ++k) {
    for (std::size_t n = 0; n < count; ++n) shares[n] = stride_[component_.slot(k, arcs[n])];
    core::shuffle(shares, random);
    for (std::size_t n = 0; n < count; ++n) keys[n] += shares[n];
  }
  arcs.erase(arcs.begin(), arcs.begin() + static_cast<std::ptrdiff_t>(count));
  for (const std::uint64_t key : keys) add(key, arcs);
}

}  // namespace nda::recovery
