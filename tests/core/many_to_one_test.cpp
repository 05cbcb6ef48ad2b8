#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/right_solution.hpp"
#include "core/shift.hpp"
#include "core/use_bounds.hpp"
#include "nda/check.hpp"
#include "nda/k_best.hpp"
#include "nda/marginals.hpp"
#include "nda/proof.hpp"
#include "support/brute_force.hpp"
#include "support/many_to_one_problems.hpp"
#include "support/matchers.hpp"
#include "support/random_problems.hpp"

// Bounds on uses: the builder, the checker and what must not be asked.

namespace nda {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr Index kUnlimited = UseBounds::kUnlimited;

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

Solution shared_solution() {
  return core::right_solution(support::shared_detection(), {5, {{1, 1}, {2, 1}}}, {{2, 3}, {0}});
}

TEST(ProblemBuilder, KeepsBoundsOnUses) {
  const Problem problem = support::shared_detection();
  EXPECT_TRUE(problem.is_many_to_one());
  EXPECT_TRUE(problem.use_bounds(0).empty());
  EXPECT_EQ(problem.use_bounds(0, 2), UseBounds{});
  EXPECT_EQ(problem.use_bounds(1, 1), (UseBounds{1, 2}));
  EXPECT_EQ(problem.use_bounds(1)[0], (UseBounds{0, kUnlimited}));
}

TEST(ProblemBuilder, ForgetsBoundsOfOneUse) {
  ProblemBuilder builder({2, 1});
  builder.set_use_bounds(0, 2, {0, 5});
  builder.set_use_bounds(0, 2, {1, 1});
  const Problem problem = std::move(builder).build();
  EXPECT_FALSE(problem.is_many_to_one());
  EXPECT_TRUE(problem.use_bounds(0).empty());
}

TEST(ProblemBuilder, NamesWhatIsWrongWithBounds) {
  ProblemBuilder builder({3, 7});
  const auto message = [&](int k, Index i, UseBounds bounds) {
    return message_of([&] { builder.set_use_bounds(k, i, bounds); });
  };
  EXPECT_EQ(message(2, 1, {}), "dimension 3 given, the problem has 2");
  EXPECT_EQ(message(-1, 1, {}), "dimension 0 given, the problem has 2");
  EXPECT_EQ(message(1, 8, {}), "index 8 of dimension 2 exceeds 7");
  EXPECT_EQ(message(1, 0, {}), "the dummy of dimension 2 has no bounds");
  EXPECT_EQ(message(0, 3, {2, 1}), "index 3 of dimension 1 must be used 2 times and may only 1");
  EXPECT_EQ(message(0, 3, {kUnlimited, kUnlimited}),
            "index 3 of dimension 1 must be used without limit");
  EXPECT_FALSE(std::move(builder).build().is_many_to_one());
}

TEST(ProblemBuilder, RefusesSingletonsThatPayWithoutLimit) {
  ProblemBuilder builder({3, 7});
  builder.add_arc({0, 5}, -2.5);
  builder.set_use_bounds(1, 5, {0, kUnlimited});
  EXPECT_EQ(message_of([&] { std::move(builder).build(); }),
            "index 5 of dimension 2 may be used without limit and alone costs -2.5: there is no "
            "least cost");
  builder.set_use_bounds(1, 5, {0, 1000});
  EXPECT_TRUE(std::move(builder).build().is_many_to_one());
}

TEST(SingletonUses, AreAsFewAsAllowedOrAsManyWhereTheyPay) {
  EXPECT_EQ(core::singleton_uses({1, 1}, 3, 0), 1u);
  EXPECT_EQ(core::singleton_uses({1, 1}, 3, 1), 0u);
  EXPECT_EQ(core::singleton_uses({1, 1}, 3, 2), std::nullopt);
  EXPECT_EQ(core::singleton_uses({1, 1}, kInfinity, 0), std::nullopt);
  EXPECT_EQ(core::singleton_uses({0, 1}, kInfinity, 0), 0u);
  EXPECT_EQ(core::singleton_uses({2, 5}, 0, 1), 1u);
  EXPECT_EQ(core::singleton_uses({2, 5}, -1, 1), 4u);
  EXPECT_EQ(core::singleton_uses({2, 5}, -1, 6), std::nullopt);
  EXPECT_EQ(core::singleton_uses({2, kUnlimited}, 3, 7), 0u);
  EXPECT_EQ(core::singleton_uses({0, 0}, -1, 0), 0u);
}

TEST(Check, AcceptsASharedDetection) {
  const CheckReport report = check(support::shared_detection(), shared_solution());
  EXPECT_THAT(report.faults, IsEmpty());
  EXPECT_EQ(report.cost, 5);
  EXPECT_DOUBLE_EQ(report.certificate_bound, 5);
  EXPECT_TRUE(report.bound_right);
}

TEST(Check, NamesWhatBoundsForbid) {
  const auto faults_of = [](const Problem& problem, std::vector<std::vector<Index>> arcs) {
    Solution solution;
    solution.sizes.assign(problem.sizes().begin(), problem.sizes().end());
    solution.solutions.push_back({1, 0, false, std::move(arcs)});
    return check(problem, solution).faults;
  };
  EXPECT_THAT(faults_of(support::shared_detection(), {{1, 1}, {1, 1}}),
              AllOf(Contains("arc (1 1) is chosen twice"),
                    Contains("index 1 of dimension 1 is used twice")));
  ProblemBuilder builder({3, 1});
  for (Index i = 1; i <= 3; ++i) builder.add_arc({i, 1}, 1);
  builder.add_arc({0, 1}, kInfinity);
  builder.set_use_bounds(1, 1, {2, 2});
  const Problem problem = std::move(builder).build();
  EXPECT_THAT(faults_of(problem, {{1, 1}, {2, 1}, {3, 1}}),
              Contains("index 1 of dimension 2 is used more than 2 times"));
  EXPECT_THAT(faults_of(problem, {{3, 1}}),
              Contains("index 1 of dimension 2 is used 1 times, must be 2, and its singleton is "
                       "forbidden"));
}

// Index 1 of dimension 1 must be used three times, at 0.1 each time alone: 0.1 + 0.1 + 0.1 is not
// what three times 0.1 is in double.
TEST(Check, CountsEveryUseOfASingleton) {
  ProblemBuilder builder({1, 1});
  builder.add_arc({1, 0}, 0.1);
  builder.set_use_bounds(0, 1, {3, 4});
  const Problem problem = std::move(builder).build();
  const auto best = support::brute_force(problem);
  EXPECT_DOUBLE_EQ(best->cost, 0.3);
  const CheckReport report = check(problem, core::right_solution(problem, *best, {{0.1}, {0}}));
  EXPECT_THAT(report.faults, IsEmpty());
  EXPECT_DOUBLE_EQ(report.cost, 0.3);
  EXPECT_DOUBLE_EQ(report.certificate_bound, 0.3);
}

Solution claim_infeasible(const Problem& problem) {
  Solution solution;
  solution.sizes.assign(problem.sizes().begin(), problem.sizes().end());
  solution.num_arcs = problem.num_arcs();
  solution.status = Status::kInfeasible;
  solution.reason = "so it is";
  solution.lower_bound = kInfinity;
  return solution;
}

TEST(Check, SeesAnIndexThatTooFewArcsHave) {
  ProblemBuilder builder({2, 1});
  builder.add_arc({1, 1}, 1);
  builder.add_arc({2, 1}, 1);
  builder.add_arc({0, 1}, kInfinity);
  ProblemBuilder enough = builder;
  builder.set_use_bounds(1, 1, {3, 4});
  const Problem problem = std::move(builder).build();
  EXPECT_TRUE(check(problem, claim_infeasible(problem)).bound_right);
  enough.set_use_bounds(1, 1, {2, 4});
  const Problem other = std::move(enough).build();
  const CheckReport report = check(other, claim_infeasible(other));
  EXPECT_FALSE(report.bound_right) << "it has a solution";
  EXPECT_TRUE(report.bound_by_branching);
}

TEST(Check, DeniesInfeasibilityWhereNothingMustBeUsed) {
  ProblemBuilder builder({1, 1});
  builder.add_arc({1, 1}, 1);
  builder.add_arc({0, 1}, kInfinity);
  builder.set_use_bounds(1, 1, {0, 4});
  const Problem problem = std::move(builder).build();
  EXPECT_THAT(check(problem, claim_infeasible(problem)).faults,
              ElementsAre(HasSubstr("leaving all alone is feasible")));
}

TEST(CertificateBound, IsBelowTheOptimumOfManyToOneProblems) {
  int num_close = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const support::RandomCase random_case = support::random_bounded_case(seed);
    SCOPED_TRACE(random_case.description);
    const auto best = support::brute_force(random_case.problem);
    if (!best) continue;
    core::Random random(seed);
    const double size = std::pow(10.0, random.uniform(-2, 1));
    const double bound = certificate_bound(
        random_case.problem, core::random_multipliers(random_case.problem, random, size));
    EXPECT_LE(bound, best->cost);
    num_close += bound > best->cost - 1;
  }
  EXPECT_GT(num_close, 20);
}

TEST(CertificateBound, ProvesNothingByPayingForUnlimitedUse) {
  ProblemBuilder builder({1, 1});
  builder.add_arc({1, 1}, 1);
  builder.set_use_bounds(1, 1, {2, kUnlimited});
  const Problem problem = std::move(builder).build();
  EXPECT_EQ(certificate_bound(problem, {{0}, {-1e-300}}), -kInfinity);
  EXPECT_EQ(certificate_bound(problem, {{0}, {-0.0}}), 0);
}

// Products that a double does not hold: 4294967294 * 0.1 is rounded.
TEST(CertificateBound, RoundsProductsDown) {
  ProblemBuilder builder({1, 1});
  builder.add_arc({1, 0}, kInfinity);
  builder.set_use_bounds(0, 1, {kUnlimited - 1, kUnlimited});
  const Problem problem = std::move(builder).build();
  const double bound = certificate_bound(problem, {{0.1}, {0}});
  const long double exact = 4294967294.0L * 0.1;
  EXPECT_LE(bound, exact);
  EXPECT_GT(bound, exact - 1e-6L);
}

TEST(CheckProof, RefusesBoundsOnUses) {
  Proof proof;
  proof.sizes = {2, 1};
  proof.num_arcs = 2;
  const ProofReport report = check_proof(support::shared_detection(), proof);
  EXPECT_EQ(report.fault, "bounds on uses have no proofs: index 1 of dimension 2 has bounds 1..2");
  EXPECT_EQ(report.lower_bound, -kInfinity);
  EXPECT_FALSE(check(support::shared_detection(), shared_solution(), proof).passed());
}

TEST(BoundsOnUses, AreRefusedByWhatDoesNotKnowThem) {
  const Problem problem = support::shared_detection();
  const std::string where =
      " cannot deal with bounds on uses: index 1 of dimension 2 has bounds 1..2";
  EXPECT_EQ(message_of([&] { core::make_shift(problem); }), "the cost shift" + where);
}

}  // namespace
}  // namespace nda
