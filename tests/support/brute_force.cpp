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
  Enumeration enumeration(problem);
  const std::optional<Leaf> best = enumeration.best();
  return best ? std::optional(to_solution(*best)) : std::nullopt;
}

std::vector<ExactSolution> all_solutions(const Problem& problem, std::size_t limit) {
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
