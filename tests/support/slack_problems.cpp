#include "support/slack_problems.hpp"

#include <algorithm>
#include <cmath>

namespace nda::support {

using bnb::RowUse;
using bnb::SlackProblem;

namespace {

// Weights of indices and a divisor: a cut that no choice of arcs without a common index violates.
struct RandomCut {
  std::vector<std::uint32_t> weights;
  std::uint32_t divisor;
  std::uint32_t total = 0;

  RandomCut(std::uint32_t num_indices, core::Random& random)
      : divisor(static_cast<std::uint32_t>(2 + random.below(3))) {
    for (std::uint32_t i = 0; i < num_indices; ++i) {
      weights.push_back(static_cast<std::uint32_t>(random.below(divisor)));
      total += weights.back();
    }
  }

  std::uint32_t coefficient(const std::vector<RowUse>& uses) const {
    std::uint32_t sum = 0;
    for (const RowUse use : uses) sum += use.row < weights.size() ? weights[use.row] : 0;
    return sum / divisor;
  }
};

}  // namespace

SlackProblem random_slack_problem(core::Random& random) {
  const auto num_indices = static_cast<std::uint32_t>(2 + random.below(7));
  SlackProblem problem(num_indices);
  const auto cost = [&] {
    return random.below(3) == 0 ? 0.0 : std::ceil(random.uniform(0, 20)) / 4;
  };
  for (std::uint32_t i = 0; i < num_indices; ++i)
    problem.add_row(random.below(9) == 0 ? kInfinity : cost());
  std::vector<RandomCut> cuts;
  for (std::size_t c = random.below(4); c > 0; --c) {
    cuts.emplace_back(num_indices, random);
    problem.add_row(cost(), cuts.back().total / cuts.back().divisor);
  }
  for (std::size_t n = random.below(14); n > 0; --n) {
    std::vector<RowUse> uses;
    for (std::uint32_t row = 0; row < num_indices; ++row) {
      if (random.below(3) == 0) uses.push_back({row, 1});
    }
    if (uses.empty()) continue;
    for (std::uint32_t c = 0; c < cuts.size(); ++c) {
      const std::uint32_t coefficient = cuts[c].coefficient(uses);
      if (coefficient > 0) uses.push_back({num_indices + c, coefficient});
    }
    problem.add_arc(cost(), uses);
  }
  return problem;
}

double slack_of(const SlackProblem& problem, const std::vector<std::uint32_t>& arcs) {
  std::vector<std::uint32_t> filled(problem.num_rows(), 0);
  double slack = 0;
  for (const std::uint32_t a : arcs) {
    slack += problem.reduced(a);
    for (const RowUse use : problem.uses(a)) filled[use.row] += use.coefficient;
  }
  for (std::uint32_t row = 0; row < problem.num_rows(); ++row) {
    const std::uint32_t capacity = problem.capacity(row);
    if (filled[row] > capacity) return kInfinity;
    if (filled[row] < capacity) slack += (capacity - filled[row]) * problem.price(row);
  }
  return slack;
}

std::vector<double> all_slacks(const SlackProblem& problem) {
  std::vector<double> slacks;
  for (std::uint32_t set = 0; set < 1u << problem.num_arcs(); ++set) {
    std::vector<std::uint32_t> arcs;
    for (std::uint32_t a = 0; a < problem.num_arcs(); ++a) {
      if ((set >> a & 1) != 0) arcs.push_back(a);
    }
    slacks.push_back(slack_of(problem, arcs));
  }
  std::sort(slacks.begin(), slacks.end());
  return slacks;
}

}  // namespace nda::support
