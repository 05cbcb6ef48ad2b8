#include "mip/comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "support/tiny_problems.hpp"

namespace nda::mip {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

MethodResult claim(double cost, double bound) {
  MethodResult result;
  result.status = "optimal";
  result.cost = cost;
  result.bound = bound;
  return result;
}

Contender fake(const std::string& name, const MethodResult& result) {
  Contender method;
  method.name = name;
  method.run = [result](const Problem&, const RunLimits&) { return result; };
  return method;
}

FileComparison compare(const std::vector<Contender>& methods) {
  return run_methods("file", support::crossing_tracks().problem, methods, {});
}

TEST(Comparison, KeepsTheOrderAndNamesTheMethods) {
  const FileComparison comparison = compare({fake("b", claim(-7, -9)), fake("a", claim(-8, -8))});
  ASSERT_EQ(comparison.results.size(), 2U);
  EXPECT_EQ(comparison.results[0].method, "b");
  EXPECT_EQ(comparison.results[1].method, "a");
  EXPECT_EQ(comparison.best_cost(), -8);
  EXPECT_EQ(comparison.best_bound(), -8);
  EXPECT_EQ(comparison.num_arcs, 4U);
  EXPECT_EQ(comparison.largest_cost, 5);
}

TEST(Comparison, OfHonestMethodsHasNoContradiction) {
  const MethodResult heuristic = claim(-7, -kInfinity);
  const MethodResult nothing = claim(kInfinity, -kInfinity);
  EXPECT_THAT(
      contradictions(compare(
          {fake("exact", claim(-8, -8)), fake("heuristic", heuristic), fake("nothing", nothing)})),
      IsEmpty());
}

TEST(Comparison, NamesBothWhenABoundExceedsACost) {
  const auto sentences =
      contradictions(compare({fake("right", claim(-8, -8)), fake("liar", claim(-7, -7.9))}));
  EXPECT_THAT(sentences,
              ElementsAre(AllOf(HasSubstr("-7.9 of liar"), HasSubstr("cost -8 of right"))));
}

TEST(Comparison, NamesAMethodThatContradictsItself) {
  EXPECT_THAT(contradictions(compare({fake("liar", claim(-8, -7))})),
              ElementsAre(AllOf(HasSubstr("of liar"), HasSubstr("cost -8 of liar"))));
}

TEST(Comparison, ForgivesRounding) {
  EXPECT_THAT(contradictions(compare(
                  {fake("a", claim(-8, -8 + 7e-6)), fake("b", claim(-8 + 7e-6, -8 + 7e-6))})),
              IsEmpty());
  EXPECT_EQ(contradictions(compare({fake("a", claim(-8, -8 + 9e-6))})).size(), 1U);
}

TEST(Comparison, ForgivesABoundItsOwnError) {
  MethodResult coarse = claim(0, 9e-7);
  EXPECT_EQ(contradictions(compare({fake("a", coarse)})).size(), 1U);
  coarse.bound_error = 1e-6;
  EXPECT_THAT(contradictions(compare({fake("a", coarse)})), IsEmpty());
}

TEST(Comparison, NamesBothWhenOneClaimsInfeasibility) {
  EXPECT_THAT(
      contradictions(
          compare({fake("right", claim(-8, -8)), fake("denier", claim(kInfinity, kInfinity))})),
      ElementsAre(AllOf(HasSubstr("denier claims"), HasSubstr("right has one of cost -8"))));
}

TEST(Comparison, SurvivesAMethodThatThrows) {
  Contender thrower;
  thrower.name = "thrower";
  thrower.run = [](const Problem&, const RunLimits&) -> MethodResult {
    throw std::runtime_error("out of order");
  };
  const FileComparison comparison = compare({thrower, fake("right", claim(-8, -8))});
  EXPECT_EQ(comparison.results[0].status, "failed");
  EXPECT_EQ(comparison.results[1].cost, -8);
  EXPECT_THAT(contradictions(comparison),
              ElementsAre(AllOf(HasSubstr("thrower"), HasSubstr("out of order"))));
}

TEST(Comparison, SkipsTheUnfitWithoutRunningThem) {
  Contender unfit;
  unfit.name = "unfit";
  unfit.unfit = [](const Problem&) { return std::string("too large"); };
  unfit.run = [](const Problem&, const RunLimits&) -> MethodResult {
    ADD_FAILURE() << "was run";
    return {};
  };
  const FileComparison comparison = compare({unfit});
  EXPECT_EQ(comparison.results[0].status, "skipped");
  EXPECT_EQ(comparison.results[0].note, "too large");
  EXPECT_THAT(contradictions(comparison), IsEmpty());
}

TEST(Comparison, RunsNothingAfterAStop) {
  std::stop_source source;
  source.request_stop();
  RunLimits limits;
  limits.stop = source.get_token();
  const FileComparison comparison = run_methods(
      "file", support::crossing_tracks().problem, {fake("late", claim(-8, -8))}, limits);
  EXPECT_EQ(comparison.results[0].status, "interrupted");
  EXPECT_FALSE(comparison.results[0].has_solution());
}

TEST(Comparison, TellsItsWatcherOfEveryRun) {
  std::string events;
  Watcher watcher;
  watcher.before = [&](const Contender& method) { events += method.name + "("; };
  watcher.after = [&](const MethodResult& result) { events += result.status + ") "; };
  run_methods("file",
              support::crossing_tracks().problem,
              {fake("a", claim(-8, -8)), fake("b", claim(-8, -8))},
              {},
              watcher);
  EXPECT_EQ(events, "a(optimal) b(optimal) ");
}

TEST(RelativeGap, IsThatOfASolution) {
  EXPECT_DOUBLE_EQ(claim(-8, -10).relative_gap(), 0.25);
  EXPECT_EQ(claim(kInfinity, -10).relative_gap(), kInfinity);
  EXPECT_EQ(claim(-8, -kInfinity).relative_gap(), kInfinity);
}

}  // namespace
}  // namespace nda::mip
