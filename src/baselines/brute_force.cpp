#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "baselines/bounded.hpp"
#include "baselines/ranked_arcs.hpp"

// Depth-first enumeration over sets of at most 64 indices held in one word.  The lowest uncovered
// index is covered by each thing that contains it in turn, its own singleton included.  A branch
// ends when its cost plus, for every uncovered index, the cheapest share cost / (number of indices)
// of anything containing it is no better than the best.  Costs are the original ones, in long
// double: no shift, so nothing is lost where prices are huge and costs are small.

namespace nda {
namespace {

constexpr std::uint32_t kSingleton = ~std::uint32_t{0};

struct Choice {
  std::uint64_t mask;
  long double cost;
  std::uint32_t arc;  // kSingleton for none
};

class Enumeration {
 public:
  explicit Enumeration(const Problem& problem) {
    choices_.resize(problem.num_indices());
    share_.assign(problem.num_indices(), kInfinity);
    add_choices(problem);
    full_ = choices_.size() == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << choices_.size()) - 1;
    for (auto& choices : choices_) {
      std::stable_sort(choices.begin(), choices.end(), [](const Choice& a, const Choice& b) {
        return a.cost < b.cost;
      });
    }
  }

  // False when there is no solution.
  bool run(std::vector<std::uint32_t>& arcs) {
    search(0, 0);
    arcs = best_arcs_;
    return found_;
  }

 private:
  void add(Choice choice) {
    slack_ += std::abs(choice.cost) * 1e-17L;
    const long double share =
        choice.cost / static_cast<long double>(__builtin_popcountll(choice.mask));
    for (std::size_t p = 0; p < choices_.size(); ++p) {
      if ((choice.mask >> p & 1) == 0) continue;
      choices_[p].push_back(choice);
      share_[p] = std::min(share_[p], share);
    }
  }

  void add_choices(const Problem& problem) {
    std::vector<std::uint64_t> arc_masks(problem.num_arcs(), 0);
    std::size_t position = 0;
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
        const Index i = problem.indices(k)[a];
        if (i != 0) arc_masks[a] |= std::uint64_t{1} << (position + i - 1);
      }
      for (Index i = 1; i <= problem.size(k); ++i, ++position) {
        const double cost = problem.singleton_costs(k)[i];
        if (cost < kInfinity) add({std::uint64_t{1} << position, cost, kSingleton});
      }
    }
    for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
      add({arc_masks[a], problem.costs()[a], static_cast<std::uint32_t>(a)});
    }
  }

  long double bound(std::uint64_t covered) const {
    long double sum = 0;
    for (std::uint64_t left = full_ & ~covered; left != 0; left &= left - 1) {
      sum += share_[static_cast<std::size_t>(__builtin_ctzll(left))];
    }
    return sum;
  }

  void search(std::uint64_t covered, long double cost) {
    if (covered == full_) {
      if (found_ && cost >= best_cost_) return;
      found_ = true;
      best_cost_ = cost;
      best_arcs_ = arcs_;
      return;
    }
    const long double reachable = cost + bound(covered);
    if (reachable == kInfinity || (found_ && reachable > best_cost_ + slack_)) return;
    for (const Choice& choice : choices_[static_cast<std::size_t>(__builtin_ctzll(~covered))]) {
      if ((choice.mask & covered) != 0) continue;
      if (choice.arc != kSingleton) arcs_.push_back(choice.arc);
      search(covered | choice.mask, cost + choice.cost);
      if (choice.arc != kSingleton) arcs_.pop_back();
    }
  }

  std::vector<std::vector<Choice>> choices_;  // [index], cheapest first
  std::vector<long double> share_;            // [index]
  std::uint64_t full_ = 0;
  long double slack_ = 0;  // bound on the rounding of any sum
  bool found_ = false;
  long double best_cost_ = 0;
  std::vector<std::uint32_t> arcs_;
  std::vector<std::uint32_t> best_arcs_;
};

void check_size(const char* what, std::size_t count, std::size_t limit) {
  if (count <= limit) return;
  throw InputError("brute force takes at most " + std::to_string(limit) + " " + what +
                   ", the problem has " + std::to_string(count));
}

}  // namespace

BaselineResult solve_brute_force(const Problem& problem) {
  check_size("arcs", problem.num_arcs(), kBruteForceMaxArcs);
  check_size("indices", problem.num_indices(), kBruteForceMaxIndices);
  if (problem.is_many_to_one()) return baselines::bounded_brute_force(problem);
  std::vector<std::uint32_t> arcs;
  if (!Enumeration(problem).run(arcs)) return {};
  return baselines::make_result(problem, std::move(arcs));
}

}  // namespace nda
