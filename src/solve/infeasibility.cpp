#include "solve/infeasibility.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "nda/assign2d.hpp"

// Three reasons, the plainest first.  An index without arcs.  A Hall set: indices of one dimension
// whose arcs all use fewer indices of another one, found by two-dimensional assignment.  Any other
// set that no packing covers: it grows from an uncovered index to what its arcs are in conflict
// with until a search proves that not all can be covered, then loses every index that the proof
// does not need.  All in limits of work, so that the reason takes no longer than the answer.

namespace nda::pipeline {
namespace {

constexpr std::size_t kMostNamed = 10;
constexpr double kMostHallWork = 5e7;    // size of the problem times dimensions
constexpr double kMostSearchSize = 1e7;  // size of the problem
constexpr std::int64_t kSearchWork = 10000000;

// "indices 1, 2 of dimension 1, index 4 of dimension 2 and 3 more".
std::string list(const std::vector<RealIndex>& indices) {
  std::string text;
  const std::size_t named = std::min(indices.size(), kMostNamed);
  for (std::size_t first = 0, last = 0; first < named; first = last) {
    const int dimension = indices[first].dimension;
    while (last < named && indices[last].dimension == dimension) ++last;
    if (first > 0) text += ", ";
    text += last - first == 1 ? "index " : "indices ";
    for (std::size_t i = first; i < last; ++i) {
      if (i > first) text += ", ";
      text += std::to_string(indices[i].index);
    }
    text += " of dimension " + std::to_string(dimension + 1);
  }
  if (indices.size() > named) text += " and " + std::to_string(indices.size() - named) + " more";
  return text;
}

// Ascending, each once.
template <typename T>
void sort_out(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

bool is_forbidden(const Problem& problem, int k, Index i) {
  return i != 0 && problem.singleton_costs(k)[i] == kInfinity;
}

double size_of(const Problem& problem) {
  return static_cast<double>(problem.num_arcs()) * problem.num_dimensions() +
         static_cast<double>(problem.num_indices());
}

struct HallSet {
  std::vector<RealIndex> indices;
  std::vector<RealIndex> partners;  // of another dimension; fewer
};

// The pairs (i, j) of indices in arcs, i of dimension k with forbidden singleton and never together
// with the dummy of dimension l; ascending.
std::vector<std::pair<Index, Index>> pairs_of(const Problem& problem, int k, int l) {
  const auto own = problem.indices(k);
  const auto other = problem.indices(l);
  std::vector<bool> needs_other(problem.size(k) + std::size_t{1}, true);
  for (std::size_t a = 0; a < own.size(); ++a) {
    if (other[a] == 0) needs_other[own[a]] = false;
  }
  std::vector<std::pair<Index, Index>> pairs;
  for (std::size_t a = 0; a < own.size(); ++a) {
    if (needs_other[own[a]] && is_forbidden(problem, k, own[a]))
      pairs.push_back({own[a], other[a]});
  }
  sort_out(pairs);
  return pairs;
}

// Indices of dimension k with fewer partners in dimension l; empty when there are none.
HallSet find_hall_set(const Problem& problem, int k, int l) {
  const auto pairs = pairs_of(problem, k, l);
  std::vector<Index> rows;
  std::vector<std::uint32_t> row_start, column;
  for (const auto& [i, j] : pairs) {
    if (rows.empty() || rows.back() != i) {
      rows.push_back(i);
      row_start.push_back(static_cast<std::uint32_t>(column.size()));
    }
    column.push_back(j - 1);
  }
  row_start.push_back(static_cast<std::uint32_t>(column.size()));
  const std::vector<double> cost(column.size(), 0);
  const std::vector<double> row_outside(rows.size(), kInfinity);
  const std::vector<double> column_outside(problem.size(l), 0);
  const Assign2dResult result = assign2d({row_start, column, cost, row_outside, column_outside});
  HallSet set;
  for (const std::uint32_t row : result.hall_rows) {
    set.indices.push_back({k, rows[row]});
    for (std::uint32_t p = row_start[row]; p < row_start[row + 1]; ++p) {
      set.partners.push_back({l, column[p] + 1});
    }
  }
  sort_out(set.partners);
  return set;
}

// The smallest that any two dimensions show, among those of uncovered indices and all others.
HallSet find_hall_set(const Problem& problem, const std::vector<RealIndex>& uncovered) {
  HallSet best;
  const int n = problem.num_dimensions();
  if (size_of(problem) * n > kMostHallWork) return best;
  for (int k = 0; k < n; ++k) {
    if (std::none_of(uncovered.begin(), uncovered.end(), [k](const RealIndex& index) {
          return index.dimension == k;
        })) {
      continue;
    }
    for (int l = 0; l < n; ++l) {
      if (l == k) continue;
      HallSet set = find_hall_set(problem, k, l);
      if (set.indices.empty()) continue;
      if (best.indices.empty() || set.indices.size() < best.indices.size()) best = std::move(set);
    }
  }
  return best;
}

// Whether sets of indices can be covered, by depth-first search over the arcs of the index with the
// fewest.
class Coverage {
 public:
  using Set = std::vector<RealIndex>;

  explicit Coverage(const Problem& problem) : problem_(problem) {
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      arcs_.emplace_back(problem.size(k) + std::size_t{1});
      used_.emplace_back(problem.size(k) + std::size_t{1}, false);
    }
    for (std::uint32_t a = 0; a < problem.num_arcs(); ++a) {
      if (!matters(a)) continue;
      for_each_index(a, [&](int k, Index i) { arcs_[at(k)][i].push_back(a); });
    }
  }

  // A set around `start` that cannot be covered, ascending, none of whose indices can be spared as
  // far as the limit of work shows; empty when there is none or it is spent.
  Set find_uncoverable(const RealIndex& start) {
    Set set = {start};
    while (!is_uncoverable(set)) {
      Set wider = widened(set);
      if (work_ < 0 || wider.size() == set.size()) return {};
      set = std::move(wider);
    }
    for (std::size_t i = set.size(); i-- > 0 && work_ >= 0;) {
      Set fewer = set;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      if (is_uncoverable(fewer)) set = std::move(fewer);
    }
    return set;
  }

 private:
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  template <typename Visit>
  void for_each_index(std::uint32_t a, Visit&& visit) const {
    for (int k = 0; k < problem_.num_dimensions(); ++k) {
      const Index i = problem_.indices(k)[a];
      if (i != 0) visit(k, i);
    }
  }

  bool matters(std::uint32_t a) const {
    bool does = false;
    for_each_index(a, [&](int k, Index i) { does = does || is_forbidden(problem_, k, i); });
    return does;
  }

  const std::vector<std::uint32_t>& arcs_of(const RealIndex& index) const {
    return arcs_[at(index.dimension)][index.index];
  }

  // The set and all forbidden-singleton indices of arcs in conflict with arcs of the set.
  Set widened(const Set& set) {
    Set wider = set;
    for (const RealIndex& index : set) {
      for (const std::uint32_t a : arcs_of(index)) {
        for_each_index(a, [&](int k, Index i) {
          for (const std::uint32_t b : arcs_of({k, i})) {
            if (--work_ < 0) return;
            for_each_index(b, [&](int m, Index j) {
              if (is_forbidden(problem_, m, j)) wider.push_back({m, j});
            });
          }
        });
      }
    }
    sort_out(wider);
    return wider;
  }

  // False too where the work does not suffice to tell.
  bool is_uncoverable(const Set& set) { return !may_cover(set) && work_ >= 0; }

  bool may_cover(const Set& set) {
    const RealIndex* next = nullptr;
    std::size_t fewest = 0;
    for (const RealIndex& index : set) {
      if (used_[at(index.dimension)][index.index]) continue;
      const std::vector<std::uint32_t>& arcs = arcs_of(index);
      const std::size_t count = static_cast<std::size_t>(
          std::count_if(arcs.begin(), arcs.end(), [this](std::uint32_t a) { return fits(a); }));
      if (next == nullptr || count < fewest) {
        next = &index;
        fewest = count;
      }
    }
    if (next == nullptr || work_ < 0) return true;
    if (fewest == 0) return false;
    for (const std::uint32_t a : arcs_of(*next)) {
      if (!fits(a)) continue;
      mark(a, true);
      const bool covered = may_cover(set);
      mark(a, false);
      if (covered) return true;
    }
    return false;
  }

  bool fits(std::uint32_t a) {
    --work_;
    bool does = true;
    for_each_index(a, [&](int k, Index i) { does = does && !used_[at(k)][i]; });
    return does;
  }

  void mark(std::uint32_t a, bool value) {
    for_each_index(a, [&](int k, Index i) { used_[at(k)][i] = value; });
  }

  const Problem& problem_;
  std::vector<std::vector<std::vector<std::uint32_t>>> arcs_;  // [k][i]: those that matter
  std::vector<std::vector<bool>> used_;
  std::int64_t work_ = kSearchWork;  // arcs that may still be looked at
};

std::vector<RealIndex> find_uncoverable(const Problem& problem,
                                        const std::vector<RealIndex>& uncovered) {
  if (size_of(problem) > kMostSearchSize) return {};
  Coverage coverage(problem);
  for (std::size_t i = 0; i < uncovered.size() && i < kMostNamed; ++i) {
    std::vector<RealIndex> set = coverage.find_uncoverable(uncovered[i]);
    if (!set.empty()) return set;
  }
  return {};
}

}  // namespace

std::string infeasibility_reason(const Problem& problem, const std::vector<RealIndex>& uncovered) {
  const std::vector<RealIndex> lonely = indices_without_arcs(problem);
  if (!lonely.empty()) return list({lonely.front()}) + " has no arc and its singleton is forbidden";
  const HallSet hall = find_hall_set(problem, uncovered);
  if (!hall.indices.empty()) {
    return list(hall.indices) + " cannot all be covered: each of their arcs uses " +
           (hall.partners.size() > 1 ? "one of " : "") + list(hall.partners);
  }
  const std::vector<RealIndex> set = find_uncoverable(problem, uncovered);
  if (!set.empty()) return list(set) + " cannot all be covered";
  return "not all indices with forbidden singletons can be covered at once: at least " +
         std::to_string(uncovered.size()) + (uncovered.size() == 1 ? " stays" : " stay") +
         " uncovered, for instance " + list(uncovered);
}

std::vector<RealIndex> indices_without_arcs(const Problem& problem) {
  std::vector<RealIndex> lonely;
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    const auto costs = problem.singleton_costs(k);
    if (std::find(costs.begin(), costs.end(), kInfinity) == costs.end()) continue;
    std::vector<bool> used(problem.size(k) + std::size_t{1}, false);
    for (const Index i : problem.indices(k)) used[i] = true;
    for (Index i = 1; i <= problem.size(k); ++i) {
      if (!used[i] && costs[i] == kInfinity) lonely.push_back({k, i});
    }
  }
  return lonely;
}

}  // namespace nda::pipeline
