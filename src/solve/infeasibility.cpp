#include "solve/infeasibility.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>

#include "core/slices.hpp"
#include "nda/assign2d.hpp"

// Three reasons, the plainest first.  An index without arcs.  A Hall set: indices of one dimension
// whose arcs all use fewer indices of another one, found by two-dimensional assignment.  Any other
// set that no packing covers: it grows from an uncovered index to what its arcs are in conflict
// with until a search proves that not all can be covered, shrinks to the indices that the proof
// branched on, then loses one after the other while what is left still cannot be covered.  All in
// limits of work, so that the reason takes no longer than the answer, and up to the deadline.

namespace nda::pipeline {
namespace {

constexpr std::size_t kMostNamed = 10;
constexpr double kMostHallWork = 5e7;    // size of the problem times dimensions
constexpr double kMostSearchSize = 1e7;  // size of the problem
constexpr std::int64_t kSearchWork = 10000000;
constexpr std::int64_t kArcsPerLook = 16384;

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
// with the dummy of dimension l; ascending.  None where the deadline strikes.
std::vector<std::pair<Index, Index>> pairs_of(const Problem& problem,
                                              int k,
                                              int l,
                                              const core::Deadline& deadline) {
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
  if (!core::sort_until(deadline, pairs, std::less<>())) return {};
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

// Indices that cannot all be assigned; none where the deadline strikes.
std::vector<std::uint32_t> hall_rows(const Assign2dProblem& problem,
                                     const core::Deadline& deadline) {
  const std::function<bool()> stop = [&deadline] { return deadline.reached(); };
  const auto solver = make_assign2d_solver(Assign2dMethod::kShortestPath);
  solver->set_stop(&stop);
  Assign2dResult result;
  try {
    solver->solve(problem, result);
  } catch (const Assign2dInterrupted&) {
    return {};
  }
  return result.hall_rows;
}

// Indices of dimension k with fewer partners in dimension l; empty when there are none.
HallSet find_hall_set(const Problem& problem, int k, int l, const core::Deadline& deadline) {
  const auto pairs = pairs_of(problem, k, l, deadline);
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
  HallSet set;
  for (const std::uint32_t row :
       hall_rows({row_start, column, cost, row_outside, column_outside}, deadline)) {
    set.indices.push_back({k, rows[row]});
    for (std::uint32_t p = row_start[row]; p < row_start[row + 1]; ++p) {
      set.partners.push_back({l, column[p] + 1});
    }
  }
  sort_out(set.partners);
  return set;
}

// The smallest that any two dimensions show, among those of uncovered indices and all others.
HallSet find_hall_set(const Problem& problem,
                      const std::vector<RealIndex>& uncovered,
                      const core::Deadline& deadline) {
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
      if (l == k || deadline.reached()) continue;
      HallSet set = find_hall_set(problem, k, l, deadline);
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

  Coverage(const Problem& problem, const core::Deadline& deadline)
      : problem_(problem), deadline_(deadline) {
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      arcs_.emplace_back(problem.size(k) + std::size_t{1});
      used_.emplace_back(problem.size(k) + std::size_t{1}, false);
    }
    const auto file_arc = [&](std::size_t a) {
      const auto arc = static_cast<std::uint32_t>(a);
      if (!matters(arc)) return;
      for_each_index(arc, [&](int k, Index i) { arcs_[at(k)][i].push_back(arc); });
    };
    if (!core::for_each_until(deadline, problem.num_arcs(), file_arc)) work_ = -1;
  }

  // A set around `start` that cannot be covered, ascending, none of whose indices can be spared as
  // far as the limit of work shows; empty when there is none or it is spent.
  Set find_uncoverable(const RealIndex& start) {
    Set set = {start};
    while (!is_uncoverable(set)) {
      Set wider = widened(set);
      if (work_ < 0 || wider.size() <= set.size()) return {};
      set = std::move(wider);
    }
    set = proof_;
    for (std::size_t needed = 0; needed < set.size() && work_ >= 0;) {
      Set fewer = set;
      fewer.erase(fewer.end() - static_cast<std::ptrdiff_t>(needed) - 1);
      if (is_uncoverable(fewer)) {
        set = proof_;
      } else {
        ++needed;
      }
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
    Set wider = touched(touched(set));
    std::erase_if(wider, [this](const RealIndex& index) {
      return !is_forbidden(problem_, index.dimension, index.index);
    });
    return wider;
  }

  // All indices of arcs of the set, ascending.
  Set touched(const Set& set) {
    Set result;
    for (const RealIndex& index : set) {
      for (const std::uint32_t a : arcs_of(index)) {
        if (!spend()) break;
        for_each_index(a, [&](int k, Index i) {
          if (!used_[at(k)][i]) result.push_back({k, i});
          used_[at(k)][i] = true;
        });
      }
    }
    for (const RealIndex& index : result) used_[at(index.dimension)][index.index] = false;
    sort_out(result);
    return result;
  }

  // One arc more was looked at; false where no more may be.
  bool spend() {
    if (--work_ % kArcsPerLook == 0 && deadline_.reached()) work_ = -1;
    return work_ >= 0;
  }

  // False too where the work does not suffice to tell.  If true, proof_ is a part of the set that
  // cannot be covered either.
  bool is_uncoverable(const Set& set) {
    proof_.clear();
    if (may_cover(set) || work_ < 0) return false;
    sort_out(proof_);
    return true;
  }

  // If false, proof_ gains every index that was branched on: the same branches fail for these.
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
    proof_.push_back(*next);
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
    spend();
    bool does = true;
    for_each_index(a, [&](int k, Index i) { does = does && !used_[at(k)][i]; });
    return does;
  }

  void mark(std::uint32_t a, bool value) {
    for_each_index(a, [&](int k, Index i) { used_[at(k)][i] = value; });
  }

  const Problem& problem_;
  const core::Deadline& deadline_;
  std::vector<std::vector<std::vector<std::uint32_t>>> arcs_;  // [k][i]: those that matter
  std::vector<std::vector<bool>> used_;
  Set proof_;
  std::int64_t work_ = kSearchWork;  // arcs that may still be looked at
};

std::vector<RealIndex> find_uncoverable(const Problem& problem,
                                        const std::vector<RealIndex>& uncovered,
                                        const core::Deadline& deadline) {
  if (size_of(problem) > kMostSearchSize || deadline.reached()) return {};
  Coverage coverage(problem, deadline);
  for (std::size_t i = 0; i < uncovered.size() && i < kMostNamed; ++i) {
    std::vector<RealIndex> set = coverage.find_uncoverable(uncovered[i]);
    if (!set.empty()) return set;
  }
  return {};
}

}  // namespace

std::string infeasibility_reason(const Problem& problem,
                                 const std::vector<RealIndex>& uncovered,
                                 const core::Deadline& deadline) {
  const std::vector<RealIndex> lonely = indices_without_arcs(problem);
  if (!lonely.empty()) return list({lonely.front()}) + " has no arc and its singleton is forbidden";
  const HallSet hall = find_hall_set(problem, uncovered, deadline);
  if (!hall.indices.empty()) {
    return list(hall.indices) + " cannot all be covered: each of their arcs uses " +
           (hall.partners.size() > 1 ? "one of " : "") + list(hall.partners);
  }
  const std::vector<RealIndex> set = find_uncoverable(problem, uncovered, deadline);
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
