#include "nda/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "core/certificate.hpp"
#include "core/check_marginals.hpp"
#include "core/double_double.hpp"
#include "core/fault_text.hpp"
#include "core/use_bounds.hpp"

// The checker knows the problem and the solution, nothing of how it was found.  Sums are kept in
// double-double.

namespace nda {
namespace {

using core::index_text;
using core::number_text;
using core::tuple_text;

bool close(double a, double b) {
  if (a == b) return true;
  if (!std::isfinite(a) || !std::isfinite(b)) return false;
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

// Walks one ranked solution: counts the uses of every index, sums the cost, reports what is wrong.
class SolutionWalk {
 public:
  SolutionWalk(const Problem& problem, std::vector<std::string>& faults)
      : problem_(problem), faults_(faults) {
    for (const Index size : problem.sizes()) uses_.emplace_back(size + std::size_t{1}, 0u);
  }

  void arc(const std::vector<Index>& tuple) {
    const auto found = problem_.find(tuple);
    if (!found) return fault("arc " + tuple_text(tuple) + " is not in the problem");
    chosen_.push_back(*found);
    add(problem_.costs()[*found]);
    for (std::size_t k = 0; k < tuple.size(); ++k) {
      if (tuple[k] != 0) use(k, tuple[k]);
    }
  }

  // After the last arc.
  void rest() {
    std::sort(chosen_.begin(), chosen_.end());
    for (std::size_t n = 1; n < chosen_.size(); ++n) {
      if (chosen_[n] == chosen_[n - 1])
        fault("arc " + tuple_text(problem_.arc(chosen_[n])) + " is chosen twice");
    }
    for (std::size_t k = 0; k < uses_.size(); ++k) {
      for (Index i = 1; i < uses_[k].size(); ++i) add_singleton(k, i);
    }
  }

  bool feasible() const { return feasible_; }
  double cost() const { return sum_.high(); }
  double magnitude() const { return magnitude_; }

 private:
  void use(std::size_t k, Index i) {
    const UseBounds bounds = problem_.use_bounds(static_cast<int>(k), i);
    if (uses_[k][i]++ == bounds.hi) {
      fault(index_text(k, i) +
            (bounds == UseBounds{} ? std::string(" is used twice")
                                   : " is used more than " + std::to_string(bounds.hi) + " times"));
    }
  }

  void add_singleton(std::size_t k, Index i) {
    const UseBounds bounds = problem_.use_bounds(static_cast<int>(k), i);
    const double cost = problem_.singleton_costs(static_cast<int>(k))[i];
    const auto times = core::singleton_uses(bounds, cost, uses_[k][i]);
    if (times && *times > 0) return add(cost, static_cast<double>(*times));
    if (times || uses_[k][i] >= bounds.lo) return;
    fault(index_text(k, i) +
          (bounds == UseBounds{}
               ? std::string(" is uncovered and its singleton forbidden")
               : " is used " + std::to_string(uses_[k][i]) + " times, must be " +
                     std::to_string(bounds.lo) + ", and its singleton is forbidden"));
  }

  void add(double cost, double times = 1) {
    const double product = times * cost;
    sum_.add(product);
    if (std::isfinite(product)) sum_.add(std::fma(times, cost, -product));
    magnitude_ += std::abs(product);
  }
  void fault(std::string sentence) {
    feasible_ = false;
    faults_.push_back(std::move(sentence));
  }

  const Problem& problem_;
  std::vector<std::string>& faults_;
  std::vector<std::vector<Index>> uses_;  // [k][i], by arcs
  std::vector<std::size_t> chosen_;       // arcs
  core::DoubleDouble sum_;
  double magnitude_ = 0;
  bool feasible_ = true;
};

std::string rank_text(const RankedSolution& ranked) {
  return "solution " + std::to_string(ranked.rank);
}

// Is the list best first, without repetition, and proven only where the whole is?
void check_ranks(const Solution& solution, CheckReport& report) {
  const std::vector<RankedSolution>& list = solution.solutions;
  std::map<std::vector<std::vector<Index>>, int> rank_of;
  for (std::size_t n = 0; n < list.size(); ++n) {
    if (list[n].rank != static_cast<int>(n + 1)) {
      report.faults.push_back("number " + std::to_string(n + 1) + " in the list has rank " +
                              std::to_string(list[n].rank));
    }
    if (n > 0 && list[n].cost < list[n - 1].cost) {
      report.faults.push_back(rank_text(list[n]) + " is stated to cost less than the one before");
    }
    const auto [same, is_new] = rank_of.try_emplace(list[n].arcs, list[n].rank);
    if (!is_new) {
      report.faults.push_back(rank_text(list[n]) + " has the arcs of solution " +
                              std::to_string(same->second));
    }
    if (solution.lists_all && !list[n].proven)
      report.faults.push_back(rank_text(list[n]) +
                              " is not proven, yet the list is stated to have all");
    const bool fits =
        n == 0 ? list[n].proven == solution.proven : !list[n].proven || solution.proven;
    if (!fits) {
      report.faults.push_back(
          rank_text(list[n]) + " is stated to be " +
          (list[n].proven ? "proven, the whole is not" : "not proven, yet the whole is"));
    }
  }
}

// Returns the sum of the absolute costs of the first solution.
double check_solutions(const Problem& problem, const Solution& solution, CheckReport& report) {
  report.feasible = report.cost_right = !solution.solutions.empty();
  double magnitude = 0;
  for (const RankedSolution& ranked : solution.solutions) {
    SolutionWalk walk(problem, report.faults);
    for (const std::vector<Index>& tuple : ranked.arcs) walk.arc(tuple);
    walk.rest();
    report.feasible = report.feasible && walk.feasible();
    const bool right = std::abs(walk.cost() - ranked.cost) <= 1e-12 * walk.magnitude() ||
                       close(walk.cost(), ranked.cost);
    if (!right) {
      report.faults.push_back(rank_text(ranked) + " states cost " + number_text(ranked.cost) +
                              ", its arcs cost " + number_text(walk.cost()));
    }
    report.cost_right = report.cost_right && right;
    if (&ranked != &solution.solutions.front()) continue;
    report.cost = walk.cost();
    magnitude = walk.magnitude();
  }
  check_ranks(solution, report);
  const double stated = solution.solutions.empty() ? kInfinity : solution.solutions.front().cost;
  if (stated != solution.cost) {
    report.cost_right = false;
    report.faults.push_back("cost " + number_text(solution.cost) +
                            " is not that of the first solution, " + number_text(stated));
  }
  return magnitude;
}

bool above(double bound, double value) {
  return !(bound <= value) && !close(bound, value);
}

// Calls note(cost) for the singletons of all real indices.
template <typename Note>
void for_each_singleton(const Problem& problem, Note&& note) {
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (const double cost : problem.singleton_costs(k).subspan(1)) note(cost);
  }
}

// Up to which gap a cost counts as proven (docs/numerics.md): a billionth of the costs that were
// chosen, or of the least cost that is not 0 where these are smaller.
double gap_tolerance(const Problem& problem, double magnitude) {
  double least = kInfinity;
  const auto note = [&](double cost) {
    if (cost != 0) least = std::min(least, std::abs(cost));
  };
  for (const double cost : problem.costs()) note(cost);
  for_each_singleton(problem, note);
  return 1e-9 * std::max(magnitude, least < kInfinity ? least : 1.0);
}

// What the multipliers prove, and whether that is what is stated.
void check_bound(const Problem& problem,
                 const Solution& solution,
                 bool with_proof,
                 double magnitude,
                 CheckReport& report) {
  const std::string fault = core::multipliers_fault(problem, solution.multipliers);
  if (!fault.empty()) return report.faults.push_back(fault);
  report.certificate_bound = certificate_bound(problem, solution.multipliers);
  report.bound_right =
      !above(solution.lower_bound, report.certificate_bound) ||
      solution.lower_bound - report.proof_bound <= gap_tolerance(problem, magnitude);
  report.bound_by_branching =
      !report.bound_right && !(with_proof && solution.proven) && solution.stats.bound_by_branching;
  if (report.bound_right || report.bound_by_branching) return;
  report.faults.push_back("lower bound " + number_text(solution.lower_bound) +
                          " is stated, the multipliers prove only " +
                          number_text(report.certificate_bound) +
                          (with_proof ? ", the proof " + number_text(report.proof_bound) : ""));
}

// No bound may exceed the verified cost, nor the stated certificate that of the multipliers.
void check_bounds_fit(const Solution& solution, CheckReport& report) {
  if (above(solution.stats.certificate_bound, report.certificate_bound)) {
    report.faults.push_back("certificate " + number_text(solution.stats.certificate_bound) +
                            " is stated, the multipliers prove " +
                            number_text(report.certificate_bound));
  }
  if (!report.feasible) return;
  if (above(solution.lower_bound, report.cost)) {
    report.bound_by_branching = false;
    report.faults.push_back("lower bound " + number_text(solution.lower_bound) +
                            " exceeds the cost " + number_text(report.cost));
  }
  if (above(report.proof_bound, report.cost)) {
    report.faults.push_back("the proof shows " + number_text(report.proof_bound) +
                            ", which exceeds the cost " + number_text(report.cost));
  }
  if (above(report.certificate_bound, report.cost)) {
    report.faults.push_back("certificate " + number_text(report.certificate_bound) +
                            " exceeds the cost " + number_text(report.cost));
  }
}

// Where every index may do without arcs and the sum does not overflow, leaving all alone is a
// solution.
bool always_feasible(const Problem& problem) {
  core::DoubleDouble sum;
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    const auto costs = problem.singleton_costs(k);
    for (Index i = 1; i <= problem.size(k); ++i) {
      const auto times = core::singleton_uses(problem.use_bounds(k, i), costs[i], 0);
      if (!times) return false;
      if (*times > 0) sum.add(static_cast<double>(*times) * costs[i]);
    }
  }
  return std::isfinite(sum.high());
}

// Whether some index cannot be used as often as it must: too few arcs have it and its singleton is
// forbidden.
bool has_hopeless_index(const Problem& problem) {
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    std::vector<std::size_t> arcs(problem.size(k) + std::size_t{1}, 0);
    for (const Index i : problem.indices(k)) ++arcs[i];
    const auto singletons = problem.singleton_costs(k);
    for (Index i = 1; i < arcs.size(); ++i) {
      if (arcs[i] < problem.use_bounds(k, i).lo && singletons[i] == kInfinity) return true;
    }
  }
  return false;
}

// Infeasible: there are no multipliers, and mostly it is the search that knows.
void check_infeasible(const Problem& problem, const Solution& solution, CheckReport& report) {
  const auto fault = [&](const std::string& text) {
    report.faults.push_back("status infeasible is stated, yet " + text);
  };
  if (!solution.solutions.empty()) fault("there is a solution");
  if (always_feasible(problem)) fault("no singleton is forbidden: leaving all alone is feasible");
  if (solution.lower_bound != kInfinity) {
    fault("the lower bound is " + number_text(solution.lower_bound));
  }
  if (solution.proven) fault("a cost is stated to be proven");
  if (solution.reason.empty()) fault("no reason is given");
  report.bound_right = has_hopeless_index(problem);
  report.bound_by_branching = !report.bound_right && report.faults.empty();
}

// What status and `proven` say must fit the two bounds (table in nda/solution.hpp).
void check_claims(const Problem& problem,
                  const Solution& solution,
                  double magnitude,
                  CheckReport& report) {
  const std::string status = to_string(solution.status);
  if (solution.solutions.empty()) {
    const bool needs_one =
        solution.status == Status::kOptimal || solution.status == Status::kGapReached;
    if (needs_one || solution.proven || always_feasible(problem)) {
      report.faults.push_back(
          "status " + status + (solution.proven ? " and proven" : "") +
          " is stated without a solution" +
          (needs_one || solution.proven ? "" : ", yet leaving all alone is one"));
    }
    return;
  }
  const bool optimal = solution.status == Status::kOptimal;
  if (optimal != solution.proven) {
    report.faults.push_back("status " + status + " is stated, yet the cost is stated to be " +
                            (solution.proven ? "proven" : "not proven"));
  }
  if (!optimal && !solution.proven) return;
  if (solution.gap() <= gap_tolerance(problem, magnitude)) return;
  report.faults.push_back(std::string(solution.proven ? "the cost is stated to be proven"
                                                      : "status optimal is stated") +
                          ", yet the lower bound " + number_text(solution.lower_bound) +
                          " does not meet it");
}

// Of solutions that are none, nothing can be said.
void check_marginals(const Solution& solution, CheckReport& report) {
  if (!solution.marginals) return;
  if (!solution.solutions.empty() && !report.feasible) return;
  const std::string fault = core::marginals_fault(solution);
  report.marginals_right = fault.empty();
  if (!fault.empty()) report.faults.push_back("marginals: " + fault);
}

CheckReport check(const Problem& problem, const Solution& solution, const Proof* proof) {
  CheckReport report;
  if (!std::equal(solution.sizes.begin(),
                  solution.sizes.end(),
                  problem.sizes().begin(),
                  problem.sizes().end())) {
    report.faults.push_back("the solution is of a problem of other sizes");
    return report;
  }
  if (proof != nullptr) {
    const ProofReport verdict = check_proof(problem, *proof);
    report.proof_bound = verdict.lower_bound;
    if (!verdict.passed()) report.faults.push_back("the proof fails: " + verdict.fault);
  }
  const double magnitude = check_solutions(problem, solution, report);
  if (solution.status == Status::kInfeasible) {
    check_infeasible(problem, solution, report);
  } else {
    check_bound(problem, solution, proof != nullptr, magnitude, report);
    check_claims(problem, solution, magnitude, report);
  }
  check_bounds_fit(solution, report);
  check_marginals(solution, report);
  return report;
}

}  // namespace

CheckReport check(const Problem& problem, const Solution& solution) {
  return check(problem, solution, nullptr);
}

CheckReport check(const Problem& problem, const Solution& solution, const Proof& proof) {
  return check(problem, solution, &proof);
}

}  // namespace nda
