#include "support/brute_force.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nda::support {
namespace {

// Anything that can be chosen: an arc or a finite singleton, with positions 0..num_indices()-1 of
// its real indices.
struct Element {
  long double cost;
  std::vector<std::size_t> covers;
  std::vector<Index> tuple;  // empty for a singleton
};

struct Leaf {
  long double cost;
  std::vector<const Element*> chosen;
};

class Enumeration {
 public:
  explicit Enumeration(const Problem& problem) {
    std::vector<std::size_t> first;
    std::size_t count = 0;
    for (const Index size : problem.sizes()) {
      first.push_back(count);
      count += size;
    }
    add_singletons(problem, first);
    add_arcs(problem, first);
    covered_.assign(count, false);
    containing_.resize(count);
    share_.assign(count, kInfinity);
    for (const Element& element : elements_) {
      slack_ += std::fabs(element.cost) * 1e-15L;
      for (const std::size_t position : element.covers) {
        containing_[position].push_back(&element);
        share_[position] = std::min(share_[position],
                                    element.cost / static_cast<long double>(element.covers.size()));
      }
    }
  }

  std::optional<Leaf> best() {
    std::optional<Leaf> best;
    search(
        0,
        0,
        [&](long double cost) { return !best || cost <= best->cost + slack_; },
        [&](const Leaf& leaf) {
          if (!best || leaf.cost < best->cost) best = leaf;
        });
    return best;
  }

  std::vector<Leaf> all(std::size_t limit) {
    std::vector<Leaf> leaves;
    search(
        0,
        0,
        [](long double) { return true; },
        [&](const Leaf& leaf) {
          if (leaves.size() == limit) throw std::length_error("too many solutions");
          leaves.push_back(leaf);
        });
    return leaves;
  }

 private:
  void add_singletons(const Problem& problem, const std::vector<std::size_t>& first) {
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      for (Index i = 1; i <= problem.size(k); ++i) {
        const double cost = problem.singleton_costs(k)[i];
        if (cost < kInfinity)
          elements_.push_back({cost, {first[static_cast<std::size_t>(k)] + i - 1}, {}});
      }
    }
  }

  void add_arcs(const Problem& problem, const std::vector<std::size_t>& first) {
    for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
      Element element{problem.costs()[a], {}, problem.arc(a)};
      for (std::size_t k = 0; k < first.size(); ++k) {
        if (element.tuple[k] != 0) element.covers.push_back(first[k] + element.tuple[k] - 1);
      }
      elements_.push_back(std::move(element));
    }
  }

  long double uncovered_share() const {
    long double sum = 0;
    for (std::size_t p = 0; p < covered_.size(); ++p) sum += covered_[p] ? 0 : share_[p];
    return sum;
  }

  bool fits(const Element& element) const {
    return std::none_of(
        element.covers.begin(), element.covers.end(), [&](std::size_t p) { return covered_[p]; });
  }

  void mark(const Element& element, bool value) {
    for (const std::size_t p : element.covers) covered_[p] = value;
  }

  template <typename Promising, typename Report>
  void search(std::size_t position,
              long double cost,
              const Promising& promising,
              const Report& report) {
    while (position < covered_.size() && covered_[position]) ++position;
    if (position == covered_.size()) {
      report(Leaf{cost, chosen_});
      return;
    }
    if (!promising(cost + uncovered_share())) return;
    for (const Element* element : containing_[position]) {
      if (!fits(*element)) continue;
      mark(*element, true);
      chosen_.push_back(element);
      search(position + 1, cost + element->cost, promising, report);
      chosen_.pop_back();
      mark(*element, false);
    }
  }

  std::vector<Element> elements_;
  std::vector<std::vector<const Element*>> containing_;  // by position
  std::vector<long double> share_;                       // by position
  std::vector<bool> covered_;                            // by position
  std::vector<const Element*> chosen_;
  long double slack_ = 0;
};

// With bounds on uses the arcs do not exclude each other, so every subset of them is looked at that
// uses nothing too often.
class SubsetEnumeration {
 public:
  explicit SubsetEnumeration(const Problem& problem) : problem_(problem) {
    if (problem.num_arcs() > 20) throw std::length_error("too many arcs");
    std::vector<std::size_t> first;
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      first.push_back(bounds_.size());
      for (Index i = 1; i <= problem.size(k); ++i) {
        bounds_.push_back(problem.use_bounds(k, i));
        singletons_.push_back(problem.singleton_costs(k)[i]);
      }
    }
    uses_.assign(bounds_.size(), 0);
    positions_.resize(problem.num_arcs());
    for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
      for (std::size_t k = 0; k < first.size(); ++k) {
        const Index i = problem.indices(static_cast<int>(k))[a];
        if (i != 0) positions_[a].push_back(first[k] + i - 1);
      }
    }
  }

  std::optional<ExactSolution> best() {
    search(0, 0);
    if (best_cost_ == kInfinity) return std::nullopt;
    ExactSolution solution{static_cast<double>(best_cost_), {}};
    for (const std::size_t a : best_) solution.arcs.push_back(problem_.arc(a));
    return solution;
  }

 private:
  void search(std::size_t a, long double cost) {
    if (a == positions_.size()) {
      for (std::size_t p = 0; p < uses_.size(); ++p) cost += alone(p);
      if (cost < best_cost_) {
        best_cost_ = cost;
        best_ = chosen_;
      }
      return;
    }
    search(a + 1, cost);
    bool fits = true;
    for (const std::size_t p : positions_[a]) fits = (++uses_[p] <= bounds_[p].hi) && fits;
    chosen_.push_back(a);
    if (fits) search(a + 1, cost + problem_.costs()[a]);
    chosen_.pop_back();
    for (const std::size_t p : positions_[a]) --uses_[p];
  }

  // The cheapest number of singletons beside the arcs.
  long double alone(std::size_t p) const {
    const auto [lo, hi] = bounds_[p];
    const long double least = lo > uses_[p] ? lo - uses_[p] : 0;
    if (singletons_[p] < 0) return (hi - uses_[p]) * static_cast<long double>(singletons_[p]);
    return least == 0 ? 0 : least * singletons_[p];
  }

  const Problem& problem_;
  std::vector<UseBounds> bounds_;   // by position
  std::vector<double> singletons_;  // by position
  std::vector<Index> uses_;         // by position
  std::vector<std::vector<std::size_t>> positions_;
  std::vector<std::size_t> chosen_;
  std::vector<std::size_t> best_;
  long double best_cost_ = kInfinity;
};

ExactSolution to_solution(const Leaf& leaf) {
  ExactSolution solution;
  solution.cost = static_cast<double>(leaf.cost);
  for (const Element* element : leaf.chosen) {
    if (!element->tuple.empty()) solution.arcs.push_back(element->tuple);
  }
  std::sort(solution.arcs.begin(), solution.arcs.end());
  return solution;
}

}  // namespace

std::optional<ExactSolution> brute_force(const Problem& problem) {
  if (problem.is_many_to_one()) return SubsetEnumeration(problem).best();
  Enumeration enumeration(problem);
  const std::optional<Leaf> best = enumeration.best();
  return best ? std::optional(to_solution(*best)) : std::nullopt;
}

std::vector<ExactSolution> all_solutions(const Problem& problem, std::size_t limit) {
  if (problem.is_many_to_one()) throw std::invalid_argument("bounds on uses");
  Enumeration enumeration(problem);
  std::vector<ExactSolution> solutions;
  for (const Leaf& leaf : enumeration.all(limit)) solutions.push_back(to_solution(leaf));
  std::stable_sort(solutions.begin(),
                   solutions.end(),
                   [](const ExactSolution& a, const ExactSolution& b) { return a.cost < b.cost; });
  return solutions;
}

std::vector<double> all_costs(const Problem& problem, std::size_t limit) {
  std::vector<double> costs;
  for (const ExactSolution& solution : all_solutions(problem, limit))
    costs.push_back(solution.cost);
  return costs;
}

}  // namespace nda::support
