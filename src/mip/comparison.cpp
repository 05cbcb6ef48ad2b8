#include "mip/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

namespace nda::mip {
namespace {

constexpr double kRelativeTolerance = 1e-6;

double largest_cost(const Problem& problem) {
  double largest = 0;
  for (const double cost : problem.costs()) largest = std::max(largest, std::abs(cost));
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (const double cost : problem.singleton_costs(k)) {
      if (cost < kInfinity) largest = std::max(largest, std::abs(cost));
    }
  }
  return largest;
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

// With both finite.
bool exceeds(const FileComparison& comparison, const MethodResult& claim, double cost) {
  const double tolerance = kRelativeTolerance * std::max(std::abs(claim.bound), std::abs(cost)) +
                           1e-9 * comparison.largest_cost + claim.bound_error;
  return claim.bound - cost > tolerance;
}

// One method that throws must not cost the results of the others.
MethodResult run_guarded(const Contender& method, const Problem& problem, const RunLimits& limits) {
  try {
    return method.run(problem, limits);
  } catch (const std::exception& error) {
    MethodResult result;
    result.status = "failed";
    result.note = error.what();
    result.faulty = true;
    return result;
  }
}

MethodResult run_one(const Contender& method,
                     const Problem& problem,
                     const RunLimits& limits,
                     const Watcher& watcher) {
  MethodResult result;
  const std::string reason = method.unfit ? method.unfit(problem) : std::string();
  if (!reason.empty()) {
    result.status = "skipped";
    result.note = reason;
  } else if (limits.stop.stop_requested()) {
    result.status = "interrupted";
  } else {
    watcher.before(method);
    result = run_guarded(method, problem, limits);
  }
  result.method = method.name;
  result.kind = method.kind;
  if (result.status != "skipped") watcher.after(result);
  return result;
}

}  // namespace

const char* to_string(MethodKind kind) {
  switch (kind) {
    case MethodKind::kNda:
      return "nda";
    case MethodKind::kBaseline:
      return "baseline";
    case MethodKind::kExternal:
      break;
  }
  return "external";
}

double MethodResult::relative_gap() const {
  if (!std::isfinite(cost) || !std::isfinite(bound)) return kInfinity;
  return (cost - bound) / std::max(1e-9, std::abs(cost));
}

double FileComparison::best_cost() const {
  double best = kInfinity;
  for (const MethodResult& result : results) best = std::min(best, result.cost);
  return best;
}

double FileComparison::best_bound() const {
  double best = -kInfinity;
  for (const MethodResult& result : results) best = std::max(best, result.bound);
  return best;
}

FileComparison run_methods(const std::string& file,
                           const Problem& problem,
                           const std::vector<Contender>& methods,
                           const RunLimits& limits,
                           const Watcher& watcher) {
  FileComparison comparison;
  comparison.file = file;
  comparison.sizes.assign(problem.sizes().begin(), problem.sizes().end());
  comparison.num_arcs = problem.num_arcs();
  comparison.largest_cost = largest_cost(problem);
  for (const Contender& method : methods) {
    comparison.results.push_back(run_one(method, problem, limits, watcher));
  }
  return comparison;
}

bool same_value(const FileComparison& comparison, double a, double b) {
  if (a == b) return true;
  if (!std::isfinite(a) || !std::isfinite(b)) return false;
  return std::abs(a - b) <=
         1e-9 * std::max(std::abs(a), std::abs(b)) + 1e-12 * comparison.largest_cost;
}

std::vector<std::string> contradictions(const FileComparison& comparison) {
  std::vector<std::string> sentences;
  for (const MethodResult& claim : comparison.results) {
    if (claim.faulty) sentences.push_back(claim.method + " is at fault: " + claim.note);
    for (const MethodResult& found : comparison.results) {
      if (!found.has_solution() || !claim.has_bound()) continue;
      if (claim.bound == kInfinity) {
        sentences.push_back(claim.method + " claims that there is no solution, " + found.method +
                            " has one of cost " + number(found.cost));
      } else if (exceeds(comparison, claim, found.cost)) {
        sentences.push_back("the bound " + number(claim.bound) + " of " + claim.method +
                            " exceeds the cost " + number(found.cost) + " of " + found.method);
      }
    }
  }
  return sentences;
}

}  // namespace nda::mip
