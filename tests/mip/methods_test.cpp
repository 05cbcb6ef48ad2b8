#include "mip/methods.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mip_support.hpp"
#include "nda/options.hpp"
#include "support/brute_force.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda::mip {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> names_of(const std::vector<Contender>& methods) {
  std::vector<std::string> names;
  for (const Contender& method : methods) names.push_back(method.name);
  return names;
}

Surroundings bare(const Scratch& scratch) {
  return {scratch.path(), scratch.path()};
}

TEST(ChooseMethods, KeepsItsOwnOrderAndTakesEachOnce) {
  const Scratch scratch;
  const MethodChoice choice =
      choose_methods({"greedy", "default", "greedy", "baseline"}, bare(scratch));
  EXPECT_THAT(
      names_of(choice.methods),
      ElementsAre("default", "greedy", "random-greedy", "max-regret", "sgts", "brute-force"));
  EXPECT_THAT(choice.missing, IsEmpty());
}

TEST(ChooseMethods, RefusesAnUnknownName) {
  const Scratch scratch;
  try {
    choose_methods({"default", "magic"}, bare(scratch));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("method 'magic' is not known; there are default, exact"));
  }
}

TEST(ChooseMethods, SaysWhichPackageBringsWhatIsMissing) {
  const Scratch scratch;
  const MethodChoice choice = choose_methods({"cbc", "glpk"}, bare(scratch));
  EXPECT_THAT(choice.methods, IsEmpty());
  EXPECT_THAT(choice.missing,
              ElementsAre("cbc is not installed (Debian package: coinor-cbc)",
                          "glpk is not installed (Debian package: glpk-utils)"));
}

std::size_t num_papers() {
  return static_cast<std::size_t>(std::ranges::count_if(presets(), &PresetInfo::is_paper));
}

TEST(ChooseMethods, TakesAllButPapersWhenNoneIsNamed) {
  const Scratch scratch;
  scratch.add_program("cbc", "");
  const MethodChoice choice = choose_methods({}, bare(scratch));
  EXPECT_THAT(names_of(choice.methods), Contains("cbc"));
  EXPECT_THAT(choice.missing, Contains(HasSubstr("glpk is not installed")));
  EXPECT_EQ(choice.methods.size() + choice.missing.size(), method_names().size() - num_papers());
}

TEST(ChooseMethods, TakesPapersByNameAndAsAGroup) {
  const Scratch scratch;
  EXPECT_EQ(choose_methods({"paper"}, bare(scratch)).methods.size(), num_papers());
  EXPECT_THAT(names_of(choose_methods({"poore-1995", "default"}, bare(scratch)).methods),
              ElementsAre("default", "poore-1995"));
}

TEST(Methods, OfOursAgreeWithBruteForceOnRandomProblems) {
  const Scratch scratch;
  const MethodChoice choice = choose_methods({"nda", "baseline"}, bare(scratch));
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const support::RandomCase random = support::random_case(seed);
    SCOPED_TRACE(random.description);
    const auto truth = support::brute_force(random.problem);
    const FileComparison comparison =
        run_methods("random", random.problem, choice.methods, {60, {}});
    EXPECT_THAT(contradictions(comparison), IsEmpty());
    const double optimum = truth ? truth->cost : kInfinity;
    EXPECT_TRUE(same_value(comparison, comparison.best_cost(), optimum))
        << comparison.best_cost() << " against " << optimum;
    for (const MethodResult& result : comparison.results) {
      SCOPED_TRACE(result.method);
      EXPECT_EQ(result.note, "");
      EXPECT_TRUE(!result.proven || same_value(comparison, result.cost, optimum)) << result.cost;
    }
  }
}

TEST(Methods, ThatDoNotKnowBoundsSayWhichTheyMet) {
  const Scratch scratch;
  ProblemBuilder builder({2, 1});
  builder.set_use_bounds(0, 2, {0, 1});
  const Problem problem = std::move(builder).build();
  std::vector<std::string> unfit;
  for (const Contender& method :
       choose_methods({"nda", "paper", "baseline"}, bare(scratch)).methods) {
    const std::string reason = method.unfit(problem);
    if (reason.empty()) continue;
    EXPECT_EQ(reason, "index 2 of dimension 1 has bounds 0..1");
    unfit.push_back(method.name);
  }
  EXPECT_THAT(unfit,
              ElementsAre("partial-bnb", "murty-bnb", "random-greedy", "max-regret", "sgts"));
}

// The engine, its relaxations and the presets of papers beside the baselines.
TEST(Methods, AgreeOnBoundsOnUses) {
  const Scratch scratch;
  const MethodChoice choice = choose_methods({"nda", "paper", "baseline"}, bare(scratch));
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const support::RandomCase random = support::random_bounded_case(seed);
    SCOPED_TRACE(random.description);
    const auto truth = support::brute_force(random.problem);
    const FileComparison comparison =
        run_methods("random", random.problem, choice.methods, {60, {}});
    EXPECT_THAT(contradictions(comparison), IsEmpty());
    EXPECT_TRUE(same_value(comparison, comparison.best_cost(), truth ? truth->cost : kInfinity));
    for (const MethodResult& result : comparison.results) EXPECT_FALSE(result.faulty);
  }
}

TEST(Methods, ThatEnumerateAreForSmallProblems) {
  const Scratch scratch;
  const MethodChoice choice = choose_methods({"enumeration", "brute-force"}, bare(scratch));
  std::vector<std::string> statuses;
  support::RandomProblemOptions options;
  options.sizes = {12, 12, 12};
  for (const int draws : {30, 50, 5000}) {
    options.num_arcs = draws;
    options.dummy_share = 0;
    const Problem problem = support::random_problem(7, options);
    for (const Contender& method : choice.methods) {
      statuses.push_back(method.name + " " + std::to_string(draws) + " " +
                         (method.unfit(problem).empty() ? "fit" : method.unfit(problem)));
    }
  }
  EXPECT_THAT(statuses,
              ElementsAre("enumeration 30 fit",
                          "brute-force 30 fit",
                          "enumeration 50 fit",
                          "brute-force 50 more than 32 arcs",
                          "enumeration 5000 more than 1000 arcs",
                          "brute-force 5000 more than 32 arcs"));
}

TEST(Methods, FromOutsideAreVerifiedAndMarkedAsSuch) {
  const Scratch scratch;
  const Scratch programs;
  programs.add_program("cbc", "echo 'Infeasible - objective value 0' > solution");
  const MethodChoice choice = choose_methods({"default", "cbc"}, {programs.path(), scratch.path()});
  const FileComparison comparison =
      run_methods("file", support::crossing_tracks().problem, choice.methods, {60, {}});
  EXPECT_EQ(comparison.results[1].kind, MethodKind::kExternal);
  EXPECT_EQ(comparison.results[1].status, "infeasible");
  EXPECT_THAT(contradictions(comparison), ElementsAre(HasSubstr("cbc claims")));
}

TEST(Methods, StopWhenAsked) {
  const Scratch scratch;
  const MethodChoice choice = choose_methods({"default"}, bare(scratch));
  std::stop_source source;
  source.request_stop();
  const MethodResult result =
      choice.methods.front().run(support::crossing_tracks().problem, {60, source.get_token()});
  EXPECT_FALSE(result.faulty) << result.note;
  EXPECT_EQ(result.status, "interrupted");
}

}  // namespace
}  // namespace nda::mip
