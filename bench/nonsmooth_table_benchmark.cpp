// Prints the tables of docs/nonsmooth.md.  No times, so the output is the same on every run.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "dual/maximize.hpp"
#include "support/nonsmooth_functions.hpp"
#include "support/planted_duals.hpp"

namespace {

using nda::DualMethod;
using nda::dual::ConcaveFunction;
using nda::dual::Iterate;
using nda::dual::MaximizeOptions;

constexpr std::array kMethods = {
    DualMethod::kBundleTrust, DualMethod::kSubgradient, DualMethod::kVolume};
constexpr int kLongRun = 1000;

/// Best value after every evaluation.
std::vector<double> history(DualMethod method,
                            ConcaveFunction& function,
                            const std::vector<double>& start,
                            int evaluations) {
  MaximizeOptions options;
  options.max_evaluations = evaluations;
  options.relative_tolerance = 0;  // of the rise from the start, often much more than |maximum|
  std::vector<double> best;
  nda::dual::maximize(method, function, start, options, [&](const Iterate& it) {
    best.push_back(it.best_value);
    return true;
  });
  return best;
}

/// First evaluation that comes within `accuracy` of the maximum, or "-".
std::string evaluations_to(const std::vector<double>& best, double maximum, double accuracy) {
  const double least = maximum - accuracy * std::max(1.0, std::abs(maximum));
  const auto hit = std::find_if(best.begin(), best.end(), [&](double q) { return q >= least; });
  return hit == best.end() ? "-" : std::to_string(hit - best.begin() + 1);
}

void print_standard_functions() {
  std::printf("| function | n | minimum |");
  for (const char* method : {"bundle trust", "subgradient", "volume"}) {
    std::printf(" %s 1e-2 | 1e-4 | 1e-7 |", method);
  }
  std::printf("\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const nda::test::NonsmoothProblem& problem : nda::test::nonsmooth_problems()) {
    std::printf("| %s | %zu | %.8g |", problem.name.c_str(), problem.size(), problem.minimum);
    for (const DualMethod method : kMethods) {
      auto function = problem.negated();
      const auto best = history(method, function, problem.start, kLongRun);
      for (const double accuracy : {1e-2, 1e-4, 1e-7}) {
        std::printf(" %s |", evaluations_to(best, -problem.minimum, accuracy).c_str());
      }
    }
    std::printf("\n");
  }
}

/// Geometric mean over ten problems of the part of the gap at the start that is left.
template <class Problem>
std::vector<double> mean_gap(const typename Problem::Size& size,
                             DualMethod method,
                             const std::vector<int>& marks) {
  constexpr int kProblems = 10;
  std::vector<double> logs(marks.size());
  for (std::uint64_t seed = 101; seed < 101 + kProblems; ++seed) {
    Problem problem(size, seed);
    const auto best =
        history(method, problem, std::vector<double>(problem.num_variables()), marks.back());
    const double range = problem.maximum() - best.front();
    for (std::size_t m = 0; m < marks.size(); ++m) {
      const std::size_t at = std::min(best.size(), static_cast<std::size_t>(marks[m])) - 1;
      logs[m] += std::log(std::max((problem.maximum() - best[at]) / range, 1e-9)) / kProblems;
    }
  }
  for (double& x : logs) x = std::exp(x);
  return logs;
}

template <class Problem>
void print_planted(const char* name, const typename Problem::Size& size, std::size_t variables) {
  const std::vector<int> marks = {10, 20, 50, 200};
  std::printf("| %s | %zu |", name, variables);
  for (const DualMethod method : kMethods) {
    for (const double gap : mean_gap<Problem>(size, method, marks)) {
      if (gap <= 1.001e-9) {
        std::printf(" 0 |");
      } else {
        std::printf(" %.2g |", 100 * gap);
      }
    }
  }
  std::printf("\n");
}

void print_planted_families() {
  std::printf("| problem | n |");
  for (const char* method : {"bundle trust", "subgradient", "volume"}) {
    std::printf(" %s 10 | 20 | 50 | 200 |", method);
  }
  std::printf("\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  using Polyhedron = nda::test::PlantedPolyhedron;
  using Packing = nda::test::PlantedPacking;
  print_planted<Polyhedron>("polyhedron, 10 of 1,000 planes active", {20, 10, 1000}, 20);
  print_planted<Polyhedron>("polyhedron, 20 of 2,000", {50, 20, 2000}, 50);
  print_planted<Polyhedron>("polyhedron, 40 of 2,000", {100, 40, 2000}, 100);
  print_planted<Polyhedron>("polyhedron, 90 of 5,000", {100, 90, 5000}, 100);
  print_planted<Packing>("packing, 3 sets of 10", {3, 10, 20, 0}, 20);
  print_planted<Packing>("packing, 4 sets of 30", {4, 30, 40, 1}, 90);
  print_planted<Packing>("packing, 5 sets of 50", {5, 50, 60, 2}, 200);
  print_planted<Packing>("packing, 5 sets of 200", {5, 200, 80, 1}, 800);
  print_planted<Packing>("packing, 8 sets of 100", {8, 100, 100, 1}, 700);
}

}  // namespace

int main() {
  std::printf("### Evaluations to an accuracy\n\n");
  print_standard_functions();
  std::printf("\n### Per cent of the gap left after so many evaluations\n\n");
  print_planted_families();
  return 0;
}
