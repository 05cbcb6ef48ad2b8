#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "baselines/bounded.hpp"
#include "baselines/ranked_arcs.hpp"

// Depth-first enumeration over the arcs in the order of the problem, each taken or left.  A branch
// ends when its cost is no better than the best even if every index could choose for itself: among
// the arcs to come it would take those whose share, cost / (number of indices), is cheapest, as
// many as its bounds allow and its singletons make worth while.  Costs are in long double.

namespace nda::baselines {
namespace {

struct Use {
  long double share;
  std::uint32_t arc;
};

class Enumeration {
 public:
  explicit Enumeration(const Problem& problem) : problem_(problem) {
    std::vector<std::size_t> first;
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      first.push_back(bounds_.size());
      for (Index i = 1; i <= problem.size(k); ++i) {
        bounds_.push_back(problem.use_bounds(k, i));
        singletons_.push_back(problem.singleton_costs(k)[i]);
      }
    }
    used_.assign(bounds_.size(), 0);
    slots_.resize(problem.num_arcs());
    cheapest_.resize(bounds_.size());
    for (std::uint32_t a = 0; a < problem.num_arcs(); ++a) add_arc(a, first);
    for (auto& uses : cheapest_) {
      std::sort(
          uses.begin(), uses.end(), [](const Use& x, const Use& y) { return x.share < y.share; });
    }
    for (std::size_t slot = 0; slot < bounds_.size(); ++slot)
      slack_ += std::abs(finite(cost_alone(bounds_[slot], singletons_[slot], 0))) * 1e-17L;
  }

  // False when there is no solution.
  bool run(std::vector<std::uint32_t>& arcs) {
    search(0, 0);
    arcs = best_arcs_;
    return best_cost_ < kInfinity;
  }

 private:
  static long double finite(long double cost) { return std::isfinite(cost) ? cost : 0; }

  void add_arc(std::uint32_t a, const std::vector<std::size_t>& first) {
    for (std::size_t k = 0; k < first.size(); ++k) {
      const Index i = problem_.indices(static_cast<int>(k))[a];
      if (i != 0) slots_[a].push_back(first[k] + i - 1);
    }
    const long double cost = problem_.costs()[a];
    slack_ += std::abs(cost) * 1e-17L;
    for (const std::size_t slot : slots_[a])
      cheapest_[slot].push_back({cost / static_cast<long double>(slots_[a].size()), a});
  }

  // The least that an index costs from arc `next` on.
  long double least(std::size_t slot, std::uint32_t next) const {
    Index used = used_[slot];
    long double shares = 0;
    long double least = cost_alone(bounds_[slot], singletons_[slot], used);
    for (const Use& use : cheapest_[slot]) {
      if (use.arc < next) continue;
      if (used == bounds_[slot].hi) break;
      shares += use.share;
      least = std::min(least, shares + cost_alone(bounds_[slot], singletons_[slot], ++used));
    }
    return least;
  }

  bool can_improve(std::uint32_t next, long double cost) const {
    for (std::size_t slot = 0; slot < used_.size(); ++slot) cost += least(slot, next);
    return cost < kInfinity && cost <= best_cost_ + slack_;
  }

  void search(std::uint32_t a, long double cost) {
    if (!can_improve(a, cost)) return;
    if (a == slots_.size()) {
      for (std::size_t slot = 0; slot < used_.size(); ++slot) cost += least(slot, a);
      if (cost >= best_cost_) return;
      best_cost_ = cost;
      best_arcs_ = arcs_;
      return;
    }
    const bool fits = std::all_of(slots_[a].begin(), slots_[a].end(), [&](std::size_t slot) {
      return used_[slot] < bounds_[slot].hi;
    });
    if (fits) {
      for (const std::size_t slot : slots_[a]) ++used_[slot];
      arcs_.push_back(a);
      search(a + 1, cost + problem_.costs()[a]);
      arcs_.pop_back();
      for (const std::size_t slot : slots_[a]) --used_[slot];
    }
    search(a + 1, cost);
  }

  const Problem& problem_;
  std::vector<UseBounds> bounds_;                // by slot
  std::vector<double> singletons_;               // by slot
  std::vector<Index> used_;                      // by slot
  std::vector<std::vector<Use>> cheapest_;       // by slot, cheapest first
  std::vector<std::vector<std::size_t>> slots_;  // by arc
  long double slack_ = 0;                        // bound on the rounding of any sum
  std::vector<std::uint32_t> arcs_;
  long double best_cost_ = kInfinity;
  std::vector<std::uint32_t> best_arcs_;
};

}  // namespace

BaselineResult bounded_brute_force(const Problem& problem) {
  std::vector<std::uint32_t> arcs;
  if (!Enumeration(problem).run(arcs)) return {};
  return make_result(problem, std::move(arcs));
}

}  // namespace nda::baselines
