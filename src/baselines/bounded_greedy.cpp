#include <optional>
#include <queue>
#include <vector>

#include "baselines/bounded.hpp"
#include "baselines/ranked_arcs.hpp"

// Greedy by what an arc adds to the cost at the moment: its own cost, less that of the singletons
// which it replaces.  It replaces them while its index is used less often than it must be, or while
// they pay; so what an arc is worth only falls as others are taken.  Hence the queue holds values
// that may be out of date, and the best one is taken only if it is still what it was.

namespace nda::baselines {
namespace {

class Greedy {
 public:
  explicit Greedy(const Problem& problem) : problem_(problem) {
    for (const Index size : problem.sizes()) used_.emplace_back(size + std::size_t{1}, 0u);
  }

  std::vector<std::uint32_t> run() {
    for (std::uint32_t a = 0; a < problem_.num_arcs(); ++a) offer(a);
    std::vector<std::uint32_t> chosen;
    while (!queue_.empty()) {
      const Offer best = queue_.top();
      queue_.pop();
      const std::optional<Value> now = value(best.arc);
      if (!now) continue;
      if (best.value < *now) {
        offer(best.arc);
        continue;
      }
      chosen.push_back(best.arc);
      for (std::size_t k = 0; k < used_.size(); ++k) ++used_[k][index(k, best.arc)];
    }
    return chosen;
  }

 private:
  struct Offer {
    Value value;
    std::uint32_t arc;

    // std::priority_queue serves the greatest: the best value, ties to the lowest arc.
    friend bool operator<(const Offer& x, const Offer& y) {
      if (y.value < x.value) return true;
      return x.value < y.value ? false : x.arc > y.arc;
    }
  };

  Index index(std::size_t k, std::uint32_t a) const {
    return problem_.indices(static_cast<int>(k))[a];
  }

  // Nothing where an index of the arc may not be used again.
  std::optional<Value> value(std::uint32_t a) const {
    Value value{0, problem_.costs()[a]};
    for (std::size_t k = 0; k < used_.size(); ++k) {
      const Index i = index(k, a);
      if (i == 0) continue;
      const UseBounds bounds = problem_.use_bounds(static_cast<int>(k), i);
      const double singleton = problem_.singleton_costs(static_cast<int>(k))[i];
      if (used_[k][i] >= bounds.hi) return std::nullopt;
      if (singleton >= 0 && used_[k][i] >= bounds.lo) continue;
      if (singleton == kInfinity)
        ++value.forced;
      else
        value.shifted -= singleton;
    }
    return value;
  }

  void offer(std::uint32_t a) {
    const std::optional<Value> now = value(a);
    if (now && *now < Value{}) queue_.push({*now, a});
  }

  const Problem& problem_;
  std::vector<std::vector<Index>> used_;  // [k][i]; of the dummies too, which nobody reads
  std::priority_queue<Offer> queue_;
};

}  // namespace

BaselineResult bounded_greedy(const Problem& problem) {
  return make_result(problem, Greedy(problem).run());
}

}  // namespace nda::baselines
