#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mip/external_solver.hpp"
#include "mip_support.hpp"
#include "support/tiny_problems.hpp"

// Adapters against scripts that answer whatever a test wants: liars, crashers, sleepers, and
// programs that are not installed here.  crossing_tracks has the columns 0 (1,1,1) -4,
// 1 (1,1,2) -5, 2 (2,2,1) -2, 3 (2,2,2) -4 and then six singletons; the best is 0 and 3, -8.

namespace nda::mip {
namespace {

class FakeSolver : public ::testing::Test {
 protected:
  ExternalAnswer answer_of(const std::string& name, const std::string& script) {
    programs_.add_program(name, script);
    const Surroundings surroundings = {programs_.path(), scratch_.path()};
    const auto solver = name == "cbc"      ? find_cbc(surroundings)
                        : name == "glpsol" ? find_glpk(surroundings)
                                           : find_highs(surroundings);
    const ExternalAnswer answer = solver->solve(support::crossing_tracks().problem, limits_);
    EXPECT_TRUE(scratch_.is_empty());
    return answer;
  }

  Scratch programs_;
  Scratch scratch_;
  ExternalLimits limits_ = {60, 60, {}};
};

void expect_fault(const ExternalAnswer& answer, const std::string& status, const char* note) {
  EXPECT_EQ(to_string(answer.status), status);
  EXPECT_EQ(answer.cost, kInfinity);
  EXPECT_EQ(answer.bound, -kInfinity);
  EXPECT_THAT(answer.note, ::testing::HasSubstr(note));
}

TEST_F(FakeSolver, CbcIsBelievedWhenItsSolutionIsOne) {
  const ExternalAnswer answer = answer_of("cbc", R"(cat > solution <<END
Optimal - objective value -8.00000000
      0 x_1_1_1                1                      -4
      3 x_2_2_2                0.9999999              -4
END
)");
  EXPECT_EQ(answer.status, ExternalStatus::kOptimal);
  EXPECT_EQ(answer.cost, -8);
  EXPECT_EQ(answer.bound, -8);
  EXPECT_EQ(answer.note, "");
}

TEST_F(FakeSolver, CbcMayNotChooseAnArcTwice) {
  expect_fault(answer_of("cbc", R"(cat > solution <<END
Optimal - objective value -8.00000000
      3 x_2_2_2                2                      -4
END
)"),
               "wrong",
               "chooses an arc 2 times");
}

TEST_F(FakeSolver, CbcStoppedByTheLimitStillHasABound) {
  const ExternalAnswer answer = answer_of("cbc", R"(cat > solution <<END
Stopped on time - objective value -7.00000000
      1 x_1_1_2                1                      -5
      2 x_2_2_1                1                      -2
END
echo 'Lower bound:                    -8.250'
)");
  EXPECT_EQ(answer.status, ExternalStatus::kTimeLimit);
  EXPECT_EQ(answer.cost, -7);
  EXPECT_NEAR(answer.bound, -8.251, 1e-9);
}

TEST_F(FakeSolver, CbcMayStopWithoutASolution) {
  const ExternalAnswer answer = answer_of(
      "cbc",
      "echo 'Stopped on time (no integer solution - continuous used) - objective value -8.5'"
      " > solution; echo '  0 x_1_1_1  0.5  -4' >> solution; echo 'Lower bound: -8.500'");
  EXPECT_EQ(answer.status, ExternalStatus::kTimeLimit);
  EXPECT_EQ(answer.cost, kInfinity);
  EXPECT_NEAR(answer.bound, -8.501, 1e-9);
  EXPECT_EQ(answer.note, "");
}

TEST_F(FakeSolver, TheCostIsRecomputed) {
  const ExternalAnswer answer = answer_of("cbc", R"(cat > solution <<END
Optimal - objective value -9.00000000
      0 x_1_1_1                1                      -4
      3 x_2_2_2                1                      -4
END
)");
  EXPECT_EQ(answer.cost, -8);
  EXPECT_EQ(answer.bound, -9);
  EXPECT_EQ(answer.note, "states the cost -9");
}

TEST_F(FakeSolver, ArcsThatMeetAreWrong) {
  expect_fault(answer_of("cbc", R"(cat > solution <<END
Optimal - objective value -9.00000000
      0 x_1_1_1                1                      -4
      1 x_1_1_2                1                      -5
END
)"),
               "wrong",
               "used twice");
}

TEST_F(FakeSolver, ColumnsThatDoNotExistAreWrong) {
  expect_fault(answer_of("cbc", R"(cat > solution <<END
Optimal - objective value -9.00000000
     10 y                      1                      -9
END
)"),
               "wrong",
               "column");
}

TEST_F(FakeSolver, FractionsAreNoSolution) {
  const ExternalAnswer answer = answer_of("cbc", R"(cat > solution <<END
Optimal - objective value -9.00000000
      0 x_1_1_1                0.5                    -4
END
)");
  EXPECT_EQ(answer.status, ExternalStatus::kFailed);
  EXPECT_EQ(answer.cost, kInfinity);
  EXPECT_THAT(answer.note, ::testing::HasSubstr("without a solution"));
}

TEST_F(FakeSolver, GarbageIsAFailure) {
  expect_fault(answer_of("cbc", "echo garbage > solution"), "failed", "exit code 0");
  expect_fault(answer_of("cbc",
                         "echo 'Optimal - objective value -8' > solution; echo a b > x;"
                         "echo '0 x 1' >> solution"),
               "failed",
               "exit code 0");
  expect_fault(answer_of("glpsol", "echo 's mip 6 10 ? x' > solution"), "failed", "exit code 0");
  expect_fault(
      answer_of("highs", "printf 'Model status\\nUnknown\\n' > solution"), "failed", "exit code 0");
}

TEST_F(FakeSolver, ACrashIsAFailure) {
  expect_fault(answer_of("cbc", "kill -SEGV $$"), "failed", "exit code 139");
}

TEST_F(FakeSolver, ASleeperIsKilled) {
  limits_ = {0.05, 0.05, {}};
  const ExternalAnswer answer = answer_of("glpsol", "echo '+ 1: mip = x >= -9.5 1%'; sleep 60");
  EXPECT_EQ(answer.status, ExternalStatus::kKilled);
  EXPECT_GE(answer.seconds, 0.105);
  EXPECT_LT(answer.seconds, 30);
  EXPECT_EQ(answer.cost, kInfinity);
}

TEST_F(FakeSolver, AStopRequestEndsIt) {
  std::stop_source source;
  source.request_stop();
  limits_.stop = source.get_token();
  EXPECT_EQ(answer_of("highs", "sleep 60").status, ExternalStatus::kInterrupted);
}

TEST_F(FakeSolver, AFullDiskIsAFailure) {
  programs_.add_program("cbc", "");
  const auto solver = find_cbc({programs_.path(), "/no/such/folder"});
  const ExternalAnswer answer = solver->solve(support::one_arc().problem, limits_);
  expect_fault(answer, "failed", "/no/such/folder");
}

TEST_F(FakeSolver, GlpkStopsWithTheBestBoundOfItsLog) {
  const ExternalAnswer answer = answer_of("glpsol", R"(cat > solution <<END
c Problem:    nda
s mip 6 10 f -7
i 1 1
j 1 0
j 2 1
j 3 1
j 4 0
e o f
END
echo '+   1: mip =  -6.000000000e+00 >=  -9.000000000e+00  50.0% (1; 0)'
echo '+   5: mip =  -7.000000000e+00 >=  -8.250000000e+00  17.0% (3; 5)'
echo 'TIME LIMIT EXCEEDED; SEARCH TERMINATED'
)");
  EXPECT_EQ(answer.status, ExternalStatus::kTimeLimit);
  EXPECT_EQ(answer.cost, -7);
  EXPECT_NEAR(answer.bound, -8.25, 1e-8);
}

// The layout of HiGHS 1.5 and later.
constexpr const char* kHighsSolution = R"(cat > solution <<END
Model status
STATUS

# Primal solution values
Feasible
Objective -8
# Columns 10
x_1_1_1 1
x_1_1_2 0
x_2_2_1 0
x_2_2_2 1.0000000001
x_1_0_0 0
x_2_0_0 0
x_0_1_0 0
x_0_2_0 0
x_0_0_1 0
x_0_0_2 0
# Rows 6
c_1_1 1
c_1_2 1
c_2_1 1
c_2_2 1
c_3_1 1
c_3_2 1

# Dual solution values
None
END
echo '  Dual bound        -8.5'
)";

std::string highs_script(const std::string& status) {
  std::string script = kHighsSolution;
  return script.replace(script.find("STATUS"), 6, status);
}

TEST_F(FakeSolver, HighsIsReadToItsEnd) {
  const ExternalAnswer answer = answer_of("highs", highs_script("Optimal"));
  EXPECT_EQ(answer.status, ExternalStatus::kOptimal);
  EXPECT_EQ(answer.cost, -8);
  EXPECT_EQ(answer.bound, -8.5);
  EXPECT_EQ(answer.note, "");
  EXPECT_EQ(answer.arcs, (std::vector<std::vector<Index>>{{1, 1, 1}, {2, 2, 2}}));
}

TEST_F(FakeSolver, HighsMayStopAtTheLimit) {
  const ExternalAnswer answer = answer_of("highs", highs_script("Time limit reached"));
  EXPECT_EQ(answer.status, ExternalStatus::kTimeLimit);
  EXPECT_EQ(answer.cost, -8);
}

TEST_F(FakeSolver, HighsMayFindNothing) {
  const ExternalAnswer answer = answer_of(
      "highs",
      "printf 'Model status\\nInfeasible\\n\\n# Primal solution values\\nNone\\n' > solution");
  EXPECT_EQ(answer.status, ExternalStatus::kInfeasible);
  EXPECT_EQ(answer.bound, kInfinity);
}

TEST(ExternalKinds, AreAbsentFromAnEmptyPath) {
  const Scratch scratch;
  for (const ExternalKind& kind : external_kinds()) {
    if (std::string(kind.name) == "scipy") continue;  // also looked for in /usr/bin
    EXPECT_EQ(kind.find({scratch.path(), scratch.path()}), nullptr) << kind.name;
  }
}

}  // namespace
}  // namespace nda::mip
