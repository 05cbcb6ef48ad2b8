#include "nda/problem.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>

#include "core/fault_text.hpp"

// A problem is stored as structure of arrays, arcs in lexicographic order: the first two dimensions
// of consecutive arcs then agree for long stretches, which is what the collapse of eq. (3.3) wants.
// Arcs are sorted by one stable counting sort per dimension, the last dimension first (radix sort
// with the dimensions as digits): O(A N + sum M_k) against O(A N log A) of comparisons.  The sort
// moves a permutation and then one column at a time, so that building needs 8 bytes an arc plus one
// column beyond the problem itself.

namespace nda {
namespace {

using Columns = std::vector<std::vector<Index>>;

// -1, 0, +1 as tuple a comes before, equals, or comes after tuple b.
int compare(const Columns& columns, std::size_t a, std::size_t b) {
  for (const std::vector<Index>& column : columns) {
    if (column[a] != column[b]) return column[a] < column[b] ? -1 : 1;
  }
  return 0;
}

using Order = std::vector<std::uint32_t>;

// Sorts by one column; arcs of equal index keep their order.
void sort_by(const std::vector<Index>& column, Index size, Order& order, Order& scratch) {
  std::vector<std::uint32_t> next(size + std::size_t{2}, 0);
  for (const Index i : column) ++next[i + std::size_t{1}];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (const std::uint32_t a : order) scratch[next[column[a]]++] = a;
  order.swap(scratch);
}

Order sorted_order(const Columns& columns, const std::vector<Index>& sizes) {
  Order order(columns.front().size());
  Order scratch(order.size());
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t k = columns.size(); k-- > 0;) sort_by(columns[k], sizes[k], order, scratch);
  return order;
}

// Keeps the first of the cheapest among equal tuples, which stand side by side in the order.
void keep_cheapest(const Columns& columns, const std::vector<double>& costs, Order& order) {
  std::size_t last = 0;
  for (std::size_t n = 1; n < order.size(); ++n) {
    if (compare(columns, order[last], order[n]) != 0) {
      order[++last] = order[n];
    } else if (costs[order[n]] < costs[order[last]]) {
      order[last] = order[n];
    }
  }
  order.resize(last + 1);
}

bool strictly_sorted(const Columns& columns, std::size_t num_arcs) {
  for (std::size_t a = 1; a < num_arcs; ++a) {
    if (compare(columns, a - 1, a) >= 0) return false;
  }
  return true;
}

template <typename T>
void permute(std::vector<T>& values, std::span<const std::uint32_t> order) {
  std::vector<T> moved(order.size());
  for (std::size_t a = 0; a < order.size(); ++a) moved[a] = values[order[a]];
  values = std::move(moved);
}

int num_real(std::span<const Index> tuple) {
  return static_cast<int>(
      std::count_if(tuple.begin(), tuple.end(), [](Index i) { return i != 0; }));
}

}  // namespace

std::size_t Problem::num_indices() const {
  return std::accumulate(sizes_.begin(), sizes_.end(), std::size_t{0});
}

bool Problem::is_many_to_one() const {
  return std::any_of(
      use_bounds_.begin(), use_bounds_.end(), [](const auto& bounds) { return !bounds.empty(); });
}

std::vector<Index> Problem::arc(std::size_t a) const {
  std::vector<Index> tuple;
  tuple.reserve(indices_.size());
  for (const std::vector<Index>& column : indices_) tuple.push_back(column[a]);
  return tuple;
}

std::optional<std::size_t> Problem::find(std::span<const Index> tuple) const {
  if (tuple.size() != sizes_.size()) return std::nullopt;
  std::size_t first = 0;
  std::size_t last = num_arcs();
  for (std::size_t k = 0; k < tuple.size(); ++k) {
    const auto range = std::equal_range(indices_[k].begin() + static_cast<std::ptrdiff_t>(first),
                                        indices_[k].begin() + static_cast<std::ptrdiff_t>(last),
                                        tuple[k]);
    first = static_cast<std::size_t>(range.first - indices_[k].begin());
    last = static_cast<std::size_t>(range.second - indices_[k].begin());
  }
  return first < last ? std::optional(first) : std::nullopt;
}

ProblemBuilder::ProblemBuilder(std::vector<Index> sizes) {
  const std::size_t n = sizes.size();
  if (n < 2 || n > static_cast<std::size_t>(kMaxDimensions)) {
    throw InputError(std::to_string(n) + " dimensions given, 2 to " +
                     std::to_string(kMaxDimensions) + " allowed");
  }
  problem_.indices_.resize(n);
  for (const Index size : sizes) {
    problem_.singleton_costs_.emplace_back(size + std::size_t{1}, 0.0);
    singleton_given_.emplace_back(size + std::size_t{1}, false);
  }
  problem_.use_bounds_.resize(n);
  problem_.sizes_ = std::move(sizes);
}

void ProblemBuilder::set_use_bounds(int k, Index i, UseBounds bounds) {
  const int n = static_cast<int>(problem_.sizes_.size());
  if (k < 0 || k >= n) {
    throw InputError("dimension " + std::to_string(k + 1) + " given, the problem has " +
                     std::to_string(n));
  }
  const std::size_t dimension = static_cast<std::size_t>(k);
  const std::string name = core::index_text(dimension, i);
  const Index size = problem_.sizes_[dimension];
  if (i == 0)
    throw InputError("the dummy of dimension " + std::to_string(k + 1) + " has no bounds");
  if (i > size) throw InputError(name + " exceeds " + std::to_string(size));
  if (bounds.lo > bounds.hi) {
    throw InputError(name + " must be used " + std::to_string(bounds.lo) + " times and may only " +
                     std::to_string(bounds.hi));
  }
  if (bounds.lo == UseBounds::kUnlimited) throw InputError(name + " must be used without limit");
  std::vector<UseBounds>& all = problem_.use_bounds_[dimension];
  if (all.empty()) {
    all.resize(size + std::size_t{1});
    all.front() = {0, UseBounds::kUnlimited};
  }
  all[i] = bounds;
}

void ProblemBuilder::reserve(std::size_t num_arcs) {
  for (std::vector<Index>& column : problem_.indices_) column.reserve(num_arcs);
  problem_.costs_.reserve(num_arcs);
}

void ProblemBuilder::add_arc(std::span<const Index> tuple, double cost) {
  const std::size_t n = problem_.sizes_.size();
  if (tuple.size() != n) {
    throw InputError("tuple has " + std::to_string(tuple.size()) + " indices, the problem " +
                     std::to_string(n) + " dimensions");
  }
  for (std::size_t k = 0; k < n; ++k) {
    if (tuple[k] > problem_.sizes_[k]) {
      throw InputError("index " + std::to_string(tuple[k]) + " of dimension " +
                       std::to_string(k + 1) + " exceeds " + std::to_string(problem_.sizes_[k]));
    }
  }
  if (std::isnan(cost) || cost == -kInfinity) {
    throw InputError(std::string("cost is ") + (std::isnan(cost) ? "NaN" : "-inf"));
  }
  const int real = num_real(tuple);
  if (real == 0) throw InputError("all indices of the tuple are 0");
  if (real == 1) {
    const std::size_t k = static_cast<std::size_t>(
        std::find_if(tuple.begin(), tuple.end(), [](Index i) { return i != 0; }) - tuple.begin());
    const Index i = tuple[k];
    double& singleton = problem_.singleton_costs_[k][i];
    if (singleton_given_[k][i]) ++problem_.num_duplicates_;
    singleton = singleton_given_[k][i] ? std::min(singleton, cost) : cost;
    singleton_given_[k][i] = true;
    return;
  }
  if (cost == kInfinity) {
    ++problem_.num_forbidden_;
    return;
  }
  if (problem_.costs_.size() == std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("more than 4294967295 arcs");
  }
  for (std::size_t k = 0; k < n; ++k) problem_.indices_[k].push_back(tuple[k]);
  problem_.costs_.push_back(cost);
}

void ProblemBuilder::settle_use_bounds() {
  for (std::size_t k = 0; k < problem_.use_bounds_.size(); ++k) {
    std::vector<UseBounds>& all = problem_.use_bounds_[k];
    bool any = false;
    for (std::size_t i = 1; i < all.size(); ++i) {
      any = any || all[i] != UseBounds{};
      const double cost = problem_.singleton_costs_[k][i];
      if (all[i].hi == UseBounds::kUnlimited && cost < 0) {
        throw InputError(core::index_text(k, i) + " may be used without limit and alone costs " +
                         core::number_text(cost) + ": there is no least cost");
      }
    }
    if (!any) all.clear();
  }
}

Problem ProblemBuilder::build() && {
  if (problem_.sizes_.empty()) throw InputError("the builder has given its problem away already");
  settle_use_bounds();
  Columns& columns = problem_.indices_;
  std::vector<double>& costs = problem_.costs_;
  if (!strictly_sorted(columns, costs.size())) {
    Order order = sorted_order(columns, problem_.sizes_);
    keep_cheapest(columns, costs, order);
    problem_.num_duplicates_ += costs.size() - order.size();
    for (std::vector<Index>& column : columns) permute(column, order);
    permute(costs, order);
  } else {
    for (std::vector<Index>& column : columns) column.shrink_to_fit();
    costs.shrink_to_fit();
  }
  return std::move(problem_);
}

}  // namespace nda
