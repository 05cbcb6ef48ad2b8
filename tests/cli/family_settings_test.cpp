#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cli/families.hpp"
#include "nda/check.hpp"
#include "nda/generate.hpp"
#include "nda/solve.hpp"

// Settings that disagree on an optimum are how a wrong bound shows where enumeration is out of
// reach.  So small problems of every family that `nda generate` knows are solved by settings that
// have little in common; all must prove the same cost, by proofs that hold where there are any.  A
// new family is a test of its own, which fails until it has small problems here.

namespace nda::cli {
namespace {

// The small problems of a family: seeds 0, 1, ... in turn, sizes changing with them.
struct SmallProblems {
  Instance (*make)(std::uint64_t seed);
  std::uint64_t count;
};

Index size_between(Index least, Index most, std::uint64_t seed) {
  return least + static_cast<Index>(seed % (most - least + 1));
}

int dimensions(int least, int most, std::uint64_t seed) {
  return static_cast<int>(
      size_between(static_cast<Index>(least), static_cast<Index>(most), seed / 2));
}

Instance poore_sparse(std::uint64_t seed) {
  PooreSparseOptions options;
  options.dimensions = dimensions(2, 5, seed);
  options.min_size = 4;
  options.max_size = size_between(4, 8, seed);
  options.arcs = options.dimensions == 2 ? 15 : 30 + seed % 4 * 10;
  options.seed = seed;
  return generate_poore_sparse(options);
}

Instance poore_dense(std::uint64_t seed) {
  PooreDenseOptions options;
  options.dimensions = dimensions(2, 4, seed);
  options.min_size = 2;
  options.max_size = size_between(2, 4, seed);
  options.seed = seed;
  return generate_poore_dense(options);
}

Instance small_tracking(TrackingOptions options, std::uint64_t seed) {
  options.scans = dimensions(3, 5, seed);
  options.targets = static_cast<int>(size_between(4, 10, seed));
  options.clutter = 3;
  options.cap = 20;
  options.seed = seed;
  return generate_tracking(options);
}

Instance lone_targets(std::uint64_t seed) {
  TrackingOptions options = tracking_preset("small");
  options.side = 300;
  return small_tracking(options, seed);
}

Instance groups(std::uint64_t seed) {
  TrackingOptions options = tracking_preset("hard6");
  options.side = 600;
  return small_tracking(options, seed);
}

Instance six_scans(std::uint64_t seed) {
  TrackingOptions options = tracking_preset("six-scan");
  options.targets = static_cast<int>(size_between(3, 6, seed));
  options.clutter = 1;
  options.cap = 15;
  options.seed = seed;
  return generate_tracking(options);
}

Instance map3(std::uint64_t seed) {
  Map3Options options;
  options.dimensions = dimensions(2, 4, seed);
  options.size = size_between(2, options.dimensions == 4 ? 3 : 6, seed);
  options.max_cost = seed % 3 == 0 ? 5 : 100;  // many ties, few
  options.seed = seed;
  return generate_map3(options);
}

Instance planted(std::uint64_t seed) {
  PlantedOptions options;
  options.dimensions = dimensions(2, 5, seed);
  options.size = size_between(5, 20, seed);
  options.arcs = 10 * options.size;
  options.spread = 4;
  options.singletons = static_cast<PlantedSingletons>(seed % 3);
  if (options.singletons == PlantedSingletons::kForbidden) options.miss_rate = 0;
  options.seed = seed;
  return generate_planted(options);
}

Instance gadgets(std::uint64_t seed) {
  GadgetsOptions options;
  options.dimensions = dimensions(3, 5, seed);
  options.gadgets = 1 + static_cast<int>(seed % 5);
  options.size = 3;
  options.arcs_per_gadget = 14;
  options.seed = seed;
  return generate_gadgets(options);
}

Instance bounded(std::uint64_t seed) {
  BoundedOptions options;
  options.dimensions = dimensions(2, 4, seed);
  options.size = size_between(3, 6, seed);
  options.arcs = 20 + seed % 3 * 20;
  options.seed = seed;
  return generate_bounded(options);
}

Instance merged(std::uint64_t seed) {
  MergedOptions options;
  options.scans = dimensions(1, 3, seed);
  options.targets = static_cast<int>(size_between(3, 8, seed));
  options.side = 100;
  options.seed = seed;
  return generate_merged(options);
}

const std::map<std::string, SmallProblems> kSmallProblems = {{"poore-5.1", {poore_sparse, 800}},
                                                             {"poore-5.3", {poore_dense, 800}},
                                                             {"tracking", {lone_targets, 300}},
                                                             {"groups", {groups, 80}},
                                                             {"six-scan", {six_scans, 80}},
                                                             {"map3", {map3, 800}},
                                                             {"planted", {planted, 60}},
                                                             {"gadgets", {gadgets, 200}},
                                                             {"bounded", {bounded, 600}},
                                                             {"merged", {merged, 300}}};

struct Setting {
  const char* name;
  Options options;
  bool is_exact = true;   // it proves the optimum
  bool shows_all = true;  // and its proof shows all of that
};

// As little in common as there is: which components are enumerated, how bounds are raised, what
// finds packings, what is left out beforehand, and who does the work.
std::vector<Setting> settings() {
  std::vector<Setting> all = {{"default", {}}};
  Options reduced;
  reduced.search.reductions = Reductions::kAll;
  reduced.relaxation.max_evaluations = 1;
  all.push_back({"all reductions", reduced});
  Options cut;
  cut.branch.exact_arcs = 0;
  cut.search.reductions = Reductions::kNone;
  cut.search.local_search = false;
  all.push_back({"nothing enumerated", cut});
  Options subgradient = cut;
  subgradient.relaxation.dual_method = DualMethod::kSubgradient;
  subgradient.relaxation.assign2d = Assign2dMethod::kAuction;
  subgradient.branch.averaged_cuts_indices = 0;
  all.push_back({"subgradients, cuts on averages", subgradient});
  Options coordinate = cut;
  coordinate.relaxation.dual_method = DualMethod::kCoordinate;
  coordinate.relaxation.kept_sets = 0;
  coordinate.relaxation.max_evaluations = 3;
  coordinate.num_threads = 2;
  all.push_back({"coordinates, two threads", coordinate});
  Options exact;
  exact.method = Method::kExact;
  all.push_back({"exact", exact});
  Options relaxation;
  relaxation.method = Method::kRelaxation;
  relaxation.relaxation.kept_sets = 3;
  all.push_back({"relaxation", relaxation, false, false});
  return all;
}

void expect_proof(const Problem& problem, const Solution& solution, bool shows_all) {
  ASSERT_TRUE(solution.proof);
  const ProofReport proof = check_proof(problem, *solution.proof);
  EXPECT_TRUE(proof.passed()) << proof.fault;
  EXPECT_LE(proof.lower_bound, solution.cost + 1e-12 * std::abs(solution.cost));
  if (shows_all) {
    EXPECT_THAT(check(problem, solution, *solution.proof).faults, ::testing::IsEmpty());
  }
}

class EveryFamily : public ::testing::TestWithParam<std::string> {
 protected:
  void expect_optimum(const Problem& problem, double optimum, Setting setting) {
    SCOPED_TRACE(setting.name);
    setting.options.proof = !problem.is_many_to_one();
    const Solution solution = solve(problem, setting.options);
    for (const ComponentReport& component : solution.components) methods_.insert(component.method);
    const CheckReport report = check(problem, solution);
    EXPECT_TRUE(report.passed()) << report.faults.front();
    if (setting.options.proof) expect_proof(problem, solution, setting.shows_all);
    const double tolerance = 1e-9 * std::abs(optimum);
    EXPECT_LE(solution.lower_bound, optimum + tolerance);
    EXPECT_GE(solution.cost, optimum - tolerance);
    if (!setting.is_exact) return;
    EXPECT_EQ(solution.status, Status::kOptimal) << to_string(solution.status);
    EXPECT_TRUE(solution.proven);
    EXPECT_LE(solution.cost, optimum + tolerance);
  }

  std::set<std::string> methods_;  // that solved components
};

TEST_P(EveryFamily, HasOneOptimumWhateverTheSettings) {
  ASSERT_TRUE(kSmallProblems.contains(GetParam())) << "no small problems of this family are here";
  const SmallProblems& problems = kSmallProblems.at(GetParam());
  const std::vector<Setting> all = settings();
  for (std::uint64_t seed = 0; seed < problems.count; ++seed) {
    const Instance instance = problems.make(seed);
    SCOPED_TRACE(instance.comments.front());
    const double optimum = instance.optimum ? *instance.optimum : solve(instance.problem).cost;
    for (const Setting& setting : all) expect_optimum(instance.problem, optimum, setting);
    if (HasFailure()) return;
  }
  EXPECT_GE(methods_.size(), 4) << "all settings go the same way";
}

INSTANTIATE_TEST_SUITE_P(Generated,
                         EveryFamily,
                         ::testing::ValuesIn(family_names()),
                         [](const auto& family) {
                           std::string name = family.param;
                           std::ranges::replace_if(
                               name, [](char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

}  // namespace
}  // namespace nda::cli
