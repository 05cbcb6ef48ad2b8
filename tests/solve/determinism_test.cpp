#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "nda/check.hpp"
#include "nda/io.hpp"
#include "nda/solve.hpp"
#include "solve/medium_problems.hpp"
#include "support/matchers.hpp"
#include "support/random_problems.hpp"

namespace nda {
namespace {

// All counters are in it.
std::string without_times(Solution solution) {
  solution.stats.read_seconds = solution.stats.solve_seconds = 0;
  solution.stats.peak_memory_bytes = 0;
  return solution_to_json(solution);
}

// Everything but times and memory, to the last bit.
void expect_same(const Solution& one, const Solution& two) {
  EXPECT_EQ(one.status, two.status);
  EXPECT_EQ(one.cost, two.cost);
  EXPECT_EQ(one.lower_bound, two.lower_bound);
  EXPECT_EQ(one.multipliers, two.multipliers);
  EXPECT_EQ(one.reason, two.reason);
  ASSERT_EQ(one.solutions.size(), two.solutions.size());
  for (std::size_t r = 0; r < one.solutions.size(); ++r) {
    EXPECT_EQ(one.solutions[r].arcs, two.solutions[r].arcs);
    EXPECT_EQ(one.solutions[r].cost, two.solutions[r].cost);
  }
  ASSERT_EQ(one.components.size(), two.components.size());
  for (std::size_t c = 0; c < one.components.size(); ++c) {
    EXPECT_EQ(one.components[c].cost, two.components[c].cost);
    EXPECT_EQ(one.components[c].lower_bound, two.components[c].lower_bound);
    EXPECT_EQ(one.components[c].method, two.components[c].method);
  }
  EXPECT_EQ(without_times(one), without_times(two));
}

std::string proof_text(const Solution& solution) {
  std::ostringstream text;
  write_proof(*solution.proof, text);
  return text.str();
}

Options with_threads(Options options, int num_threads) {
  options.num_threads = num_threads;
  return options;
}

Options branching() {
  Options options;
  options.branch.exact_arcs = 0;
  options.relaxation.max_evaluations = 10;
  return options;
}

Options cutting_on_averages() {
  Options options = branching();
  options.branch.averaged_cuts_indices = 0;
  return options;
}

TEST(Determinism, ThreadsDoNotChangeTheAnswer) {
  for (const Options& options : {Options{}, branching(), cutting_on_averages()}) {
    for (const Problem* problem :
         {&gadgets().problem, &planted(PlantedSingletons::kPriced).problem}) {
      const Solution single = solve(*problem, options);
      for (const int num_threads : {2, 3, 0}) {
        SCOPED_TRACE(num_threads);
        expect_same(single, solve(*problem, with_threads(options, num_threads)));
      }
    }
  }
}

TEST(Determinism, ThreadsDoNotChangeTheAnswerOnRandomProblems) {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const support::RandomCase random = support::random_case(seed);
    SCOPED_TRACE(random.description);
    expect_same(solve(random.problem), solve(random.problem, with_threads({}, 2)));
    if (HasFailure()) return;
  }
}

// One component each, with a gap: searches within the slack and neighbourhoods are shared out, and
// the only work there is for a second thread is within the component.
TEST(Determinism, ThreadsThatShareAComponentDoNotChangeTheAnswer) {
  std::int64_t nodes = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    PooreSparseOptions hard;
    hard.min_size = hard.max_size = 14;
    hard.arcs = 1200;
    hard.seed = seed;
    const Problem problem = generate_poore_sparse(hard).problem;
    Options options;
    options.branch.max_nodes = 60000;
    options.proof = true;
    const Solution single = solve(problem, options);
    for (const int num_threads : {2, 3, 8}) {
      SCOPED_TRACE(num_threads);
      const Solution several = solve(problem, with_threads(options, num_threads));
      expect_same(single, several);
      EXPECT_EQ(proof_text(single), proof_text(several));
    }
    EXPECT_TRUE(check(problem, single, *single.proof).passed());
    nodes += single.stats.nodes;
  }
  EXPECT_GT(nodes, 100000);
}

TEST(Determinism, SameSeedSameAnswer) {
  Options options;
  options.method = Method::kRelaxation;
  options.relaxation.max_evaluations = 15;
  options.seed = 77;
  const Solution one = solve(hard_problem(), options);
  expect_same(one, solve(hard_problem(), options));
}

TEST(Determinism, AnySeedFindsTheOptimum) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    Options options = branching();
    options.seed = seed;
    const Solution solution = solve(gadgets().problem, options);
    EXPECT_EQ(solution.status, Status::kOptimal);
    EXPECT_EQ(solution.cost, *gadgets().optimum);
  }
}

TEST(KnownOptima, AreFoundAndProven) {
  for (const Instance* instance : {&gadgets(),
                                   &planted(PlantedSingletons::kFree),
                                   &planted(PlantedSingletons::kPriced),
                                   &planted(PlantedSingletons::kForbidden)}) {
    ASSERT_TRUE(instance->optimum);
    const Solution solution = solve(instance->problem);
    SCOPED_TRACE(instance->comments.at(0));
    EXPECT_EQ(solution.status, Status::kOptimal);
    EXPECT_TRUE(check(instance->problem, solution).passed());
    EXPECT_NEAR(solution.cost, *instance->optimum, 1e-9 * std::abs(*instance->optimum));
    EXPECT_THAT(solution, support::BracketsOptimum(*instance->optimum));
  }
}

// Without a gap the multipliers leave hardly any choice: no linear program is needed.
TEST(KnownOptima, WithoutAGapNeedNoBranching) {
  for (const PlantedSingletons kind :
       {PlantedSingletons::kFree, PlantedSingletons::kPriced, PlantedSingletons::kForbidden}) {
    Options options;
    options.proof = true;
    options.branch.exact_arcs = 0;
    const Problem& problem = planted(kind).problem;
    const Solution solution = solve(problem, options);
    EXPECT_TRUE(solution.proven);
    EXPECT_LT(solution.stats.nodes, 100);
    for (const ComponentReport& component : solution.components)
      EXPECT_NE(component.method, "branch and cut");
    const CheckReport report = check(problem, solution, *solution.proof);
    EXPECT_TRUE(report.passed());
    EXPECT_TRUE(report.bound_right);
  }
}

}  // namespace
}  // namespace nda
