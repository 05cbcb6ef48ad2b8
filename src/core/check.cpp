#include "nda/check.hpp"

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "core/double_double.hpp"

// The checker knows the problem and the solution, nothing of how it was found.  Sums are kept in
// double-double; the certificate is then rounded downwards by a bound on all its rounding errors:
// each of the T additions errs by at most 2^-104 of a partial sum, no partial sum exceeds the sum S
// of the absolute values of all terms, so the whole errs by less than T 2^-104 S.  Where that
// underflows the next double above it is taken.

namespace nda {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

std::string tuple_text(const std::vector<Index>& tuple) {
  std::string text = "(";
  for (const Index i : tuple) text += (text.size() > 1 ? " " : "") + std::to_string(i);
  return text + ")";
}

bool close(double a, double b) {
  if (a == b) return true;
  if (!std::isfinite(a) || !std::isfinite(b)) return false;
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

// Walks one ranked solution: marks covered indices, sums the cost, reports what is wrong.
class SolutionWalk {
 public:
  SolutionWalk(const Problem& problem, std::vector<std::string>& faults)
      : problem_(problem), faults_(faults) {
    for (const Index size : problem.sizes()) covered_.emplace_back(size + std::size_t{1}, false);
  }

  void arc(const std::vector<Index>& tuple) {
    const auto found = problem_.find(tuple);
    if (!found) return fault("arc " + tuple_text(tuple) + " is not in the problem");
    add(problem_.costs()[*found]);
    for (std::size_t k = 0; k < tuple.size(); ++k) {
      if (tuple[k] == 0) continue;
      if (covered_[k][tuple[k]]) fault(place(k, tuple[k]) + " is used twice");
      covered_[k][tuple[k]] = true;
    }
  }

  void uncovered() {
    for (std::size_t k = 0; k < covered_.size(); ++k) {
      const auto costs = problem_.singleton_costs(static_cast<int>(k));
      for (std::size_t i = 1; i < covered_[k].size(); ++i) {
        if (covered_[k][i]) continue;
        if (costs[i] == kInfinity)
          fault(place(k, i) + " is uncovered and its singleton forbidden");
        else
          add(costs[i]);
      }
    }
  }

  bool feasible() const { return feasible_; }
  double cost() const { return sum_.high(); }
  double magnitude() const { return magnitude_; }

 private:
  static std::string place(std::size_t k, std::size_t i) {
    return "index " + std::to_string(i) + " of dimension " + std::to_string(k + 1);
  }
  void add(double cost) {
    sum_.add(cost);
    magnitude_ += std::abs(cost);
  }
  void fault(std::string sentence) {
    feasible_ = false;
    faults_.push_back(std::move(sentence));
  }

  const Problem& problem_;
  std::vector<std::string>& faults_;
  std::vector<std::vector<bool>> covered_;
  core::DoubleDouble sum_;
  double magnitude_ = 0;
  bool feasible_ = true;
};

void check_solutions(const Problem& problem, const Solution& solution, CheckReport& report) {
  report.feasible = report.cost_right = true;
  for (const RankedSolution& ranked : solution.solutions) {
    SolutionWalk walk(problem, report.faults);
    for (const std::vector<Index>& tuple : ranked.arcs) walk.arc(tuple);
    walk.uncovered();
    report.feasible = report.feasible && walk.feasible();
    const bool right = std::abs(walk.cost() - ranked.cost) <= 1e-12 * walk.magnitude() ||
                       close(walk.cost(), ranked.cost);
    if (!right) {
      report.faults.push_back("solution " + std::to_string(ranked.rank) + " states cost " +
                              number(ranked.cost) + ", its arcs cost " + number(walk.cost()));
    }
    report.cost_right = report.cost_right && right;
    if (&ranked == &solution.solutions.front()) report.cost = walk.cost();
  }
  const double stated = solution.solutions.empty() ? kInfinity : solution.solutions.front().cost;
  if (stated != solution.cost) {
    report.cost_right = false;
    report.faults.push_back("cost " + number(solution.cost) +
                            " is not that of the first solution, " + number(stated));
  }
}

// What is wrong with the shape or the values of multipliers; empty when nothing is.
std::string multipliers_fault(const Problem& problem,
                              const std::vector<std::vector<double>>& multipliers) {
  if (multipliers.size() != static_cast<std::size_t>(problem.num_dimensions())) {
    return "multipliers of " + std::to_string(multipliers.size()) +
           " dimensions, the problem has " + std::to_string(problem.num_dimensions());
  }
  for (std::size_t k = 0; k < multipliers.size(); ++k) {
    const std::string place = "dimension " + std::to_string(k + 1);
    if (multipliers[k].size() != problem.sizes()[k]) {
      return place + " has " + std::to_string(multipliers[k].size()) + " multipliers, not " +
             std::to_string(problem.sizes()[k]);
    }
    for (const double u : multipliers[k]) {
      if (!std::isfinite(u)) return "a multiplier of " + place + " is not finite";
    }
  }
  return {};
}

void check_bound(const Problem& problem, const Solution& solution, CheckReport& report) {
  if (solution.status == Status::kInfeasible) {
    report.bound_right = report.bound_by_branching = true;
    return;
  }
  const std::string fault = multipliers_fault(problem, solution.multipliers);
  if (!fault.empty()) return report.faults.push_back(fault);
  report.certificate_bound = certificate_bound(problem, solution.multipliers);
  report.bound_right = true;
  if (solution.lower_bound <= report.certificate_bound ||
      close(solution.lower_bound, report.certificate_bound)) {
    return;
  }
  report.bound_by_branching = solution.stats.bound_by_branching;
  if (!report.bound_by_branching) {
    report.bound_right = false;
    report.faults.push_back("lower bound " + number(solution.lower_bound) +
                            " is stated, the multipliers prove only " +
                            number(report.certificate_bound));
  } else if (!(solution.lower_bound <= report.cost) && !close(solution.lower_bound, report.cost)) {
    report.bound_right = false;
    report.faults.push_back("lower bound " + number(solution.lower_bound) + " exceeds the cost " +
                            number(report.cost));
  }
}

// Where equal costs cannot be told from different ones: a billionth of the largest cost, or of 1 if
// all are 0.
double cost_tolerance(const Problem& problem, double cost) {
  double largest = std::abs(cost);
  for (const double c : problem.costs()) largest = std::max(largest, std::abs(c));
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (const double c : problem.singleton_costs(k)) {
      if (c < kInfinity) largest = std::max(largest, std::abs(c));
    }
  }
  return 1e-9 * (largest > 0 ? largest : 1.0);
}

// What status and `proven` say must fit the two bounds (table in nda/solution.hpp).
void check_claims(const Problem& problem, const Solution& solution, CheckReport& report) {
  if (solution.status == Status::kInfeasible) {
    if (!solution.solutions.empty()) {
      report.faults.push_back("status infeasible is stated, yet there is a solution");
    }
    return;
  }
  if (solution.status != Status::kOptimal && !solution.proven) return;
  if (solution.gap() <= cost_tolerance(problem, solution.cost)) return;
  const std::string claim =
      solution.proven ? "the cost is stated to be proven, yet" : "status optimal is stated, yet";
  report.faults.push_back(claim + " the lower bound " + number(solution.lower_bound) +
                          " does not meet it");
}

}  // namespace

CheckReport check(const Problem& problem, const Solution& solution) {
  CheckReport report;
  if (!std::equal(solution.sizes.begin(),
                  solution.sizes.end(),
                  problem.sizes().begin(),
                  problem.sizes().end())) {
    report.faults.push_back("the solution is of a problem of other sizes");
    return report;
  }
  check_solutions(problem, solution, report);
  check_bound(problem, solution, report);
  check_claims(problem, solution, report);
  return report;
}

double certificate_bound(const Problem& problem,
                         const std::vector<std::vector<double>>& multipliers) {
  const std::string fault = multipliers_fault(problem, multipliers);
  if (!fault.empty()) throw InputError(fault);
  core::DoubleDouble bound;
  double magnitude = 0;
  const auto add = [&](double term) {
    bound.add(term);
    magnitude += std::abs(term);
  };
  const std::size_t n = multipliers.size();
  for (std::size_t k = 0; k < n; ++k) {
    const auto singletons = problem.singleton_costs(static_cast<int>(k));
    for (std::size_t i = 1; i < singletons.size(); ++i) {
      const double u = multipliers[k][i - 1];
      add(u);
      if (singletons[i] < u) {
        add(singletons[i]);
        add(-u);
      }
    }
  }
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
    core::DoubleDouble reduced(problem.costs()[a]);
    double size = std::abs(problem.costs()[a]);
    for (std::size_t k = 0; k < n; ++k) {
      const Index i = problem.indices(static_cast<int>(k))[a];
      if (i == 0) continue;
      reduced.add(-multipliers[k][i - 1]);
      size += std::abs(multipliers[k][i - 1]);
    }
    // Where the sum may have overflown its sign says nothing.
    if (!reduced.negative() && std::isfinite(size)) continue;
    add(reduced.high());
    add(reduced.low());
    magnitude += size;
  }
  if (magnitude == 0) return 0;
  if (!std::isfinite(magnitude)) return -kInfinity;
  const double terms =
      static_cast<double>(problem.num_arcs() * (n + 2) + 3 * problem.num_indices());
  bound.add(-std::nextafter(terms * 0x1p-100 * magnitude, kInfinity));
  return std::nextafter(bound.high(), -kInfinity);
}

}  // namespace nda
