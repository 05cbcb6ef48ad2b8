#include "relax/dual_function.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/components.hpp"
#include "support/no_alloc.hpp"
#include "support/tiny_problems.hpp"

namespace nda::relax {
namespace {

using core::ArcId;
using core::Component;
using support::sum_of;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kTie = 1e-9;

const Assign2dMethod kMethods[] = {
    Assign2dMethod::kShortestPath, Assign2dMethod::kAuction, Assign2dMethod::kNetworkSimplex};

bool is_dummy(const Component& component, std::uint32_t slot) {
  return std::find(component.offset.begin(), component.offset.end(), slot) !=
         component.offset.end();
}

// Multipliers of the relaxed slots, of any sign; sometimes exactly 0.
std::vector<double> random_point(const Component& component,
                                 const DualFunction& function,
                                 core::Random& random) {
  std::vector<double> u(function.num_variables());
  for (std::size_t j = 0; j < u.size(); ++j) {
    const auto slot = static_cast<std::uint32_t>(function.first_slot() + j);
    u[j] = is_dummy(component, slot) || random.below(5) == 0 ? 0.0 : random.uniform(-12, 4);
  }
  return u;
}

double reduced(const Component& component,
               const DualFunction& function,
               std::span<const double> u,
               ArcId a) {
  double r = component.costs[a];
  for (int k = 2; k < component.num_dimensions(); ++k) {
    r -= u[component.slot(k, a) - function.first_slot()];
  }
  return r;
}

// q(u) from the arcs the function says it chose.
double value_of_choice(const Component& component,
                       const DualFunction& function,
                       std::span<const double> u) {
  double value = 0;
  for (const double multiplier : u) value += std::min(0.0, multiplier);
  for (const ArcId a : function.chosen_arcs()) value += reduced(component, function, u, a);
  return value;
}

// Dimensions 0 and 1 at most once, and every cheap arc of cell (0, 0).
void expect_choice_is_feasible_for_the_relaxation(const Component& component,
                                                  const DualFunction& function,
                                                  std::span<const double> u) {
  std::vector<int> uses(component.num_slots(), 0);
  std::vector<bool> chosen(component.num_arcs(), false);
  for (const ArcId a : function.chosen_arcs()) {
    EXPECT_FALSE(chosen[a]) << "arc " << a << " twice";
    chosen[a] = true;
    ++uses[component.slot(0, a)];
    ++uses[component.slot(1, a)];
  }
  for (std::size_t k = 0; k < 2; ++k) {
    for (Index i = 1; i <= component.sizes[k]; ++i) EXPECT_LE(uses[component.offset[k] + i], 1);
  }
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    if (component.index(0, a) != 0 || component.index(1, a) != 0) continue;
    const double r = reduced(component, function, u, a);
    if (std::abs(r) > kTie) {
      EXPECT_EQ(chosen[a], r < 0);
    }
  }
}

void expect_alignment_is_that_of_the_choice(const Component& component,
                                            const DualFunction& function) {
  std::vector<std::pair<Index, Index>> from_arcs;
  for (const ArcId a : function.chosen_arcs()) {
    const std::pair<Index, Index> cell{component.index(0, a), component.index(1, a)};
    if (cell != std::pair<Index, Index>{0, 0}) from_arcs.push_back(cell);
  }
  std::vector<std::pair<Index, Index>> aligned;
  for (const std::uint32_t cell : function.aligned_cells()) {
    aligned.push_back({function.cells().row[cell], function.cells().column[cell]});
  }
  EXPECT_THAT(aligned, ::testing::UnorderedElementsAreArray(from_arcs));
}

// The dual function of a random component at a random point.
struct Evaluated {
  const Component& component;
  DualFunction& function;
  const std::vector<double>& u;
  double q;
  const std::vector<double>& g;
};

class RandomDuals : public ::testing::TestWithParam<Assign2dMethod> {
 protected:
  template <typename Check>
  void for_random_points(std::uint64_t num_components, Check&& check) {
    for (std::uint64_t seed = 0; seed < num_components; ++seed) {
      SCOPED_TRACE(seed);
      random_ = core::Random(seed);
      const Component component = support::random_component_of_any_kind(seed);
      DualFunction function(component, GetParam());
      for (int point = 0; point < 4; ++point) {
        const std::vector<double> u = random_point(component, function, random_);
        std::vector<double> g(u.size());
        const double q = function.evaluate(u, g);
        check(Evaluated{component, function, u, q, g});
      }
      if (HasFailure()) return;
    }
  }

  core::Random random_{0};
};

TEST_P(RandomDuals, NeverExceedTheOptimum) {
  for_random_points(
      600, [](const Evaluated& at) { EXPECT_LE(at.q, support::best_cost(at.component) + kTie); });
}

TEST_P(RandomDuals, AreAttainedByTheChosenArcs) {
  for_random_points(1500, [](const Evaluated& at) {
    EXPECT_NEAR(at.q, value_of_choice(at.component, at.function, at.u), kTie);
    expect_choice_is_feasible_for_the_relaxation(at.component, at.function, at.u);
    expect_alignment_is_that_of_the_choice(at.component, at.function);
  });
}

// Eq. (4.4): one minus the uses by arcs and by the singleton, which is used where u > 0 and free to
// choose at 0.
TEST_P(RandomDuals, SubgradientCountsUses) {
  for_random_points(800, [](const Evaluated& at) {
    std::vector<double> uses(at.component.num_slots(), 0);
    for (const ArcId a : at.function.chosen_arcs()) {
      core::for_each_slot(at.component, a, [&](std::uint32_t s) { ++uses[s]; });
    }
    for (std::size_t j = 0; j < at.u.size(); ++j) {
      const auto slot = static_cast<std::uint32_t>(at.function.first_slot() + j);
      if (is_dummy(at.component, slot)) {
        EXPECT_EQ(at.g[j], 0);
      } else if (at.u[j] != 0) {
        EXPECT_EQ(at.g[j], 1 - uses[slot] - (at.u[j] > 0 ? 1 : 0));
      } else {
        EXPECT_EQ(at.g[j], uses[slot] == 0 ? 0 : 1 - uses[slot]);
      }
    }
  });
}

TEST_P(RandomDuals, SubgradientSupportsTheFunctionEverywhere) {
  for_random_points(800, [&](const Evaluated& at) {
    const std::vector<double> w = random_point(at.component, at.function, random_);
    std::vector<double> ignored(w.size());
    double bound = at.q;
    for (std::size_t j = 0; j < w.size(); ++j) bound += at.g[j] * (w[j] - at.u[j]);
    EXPECT_LE(at.function.evaluate(w, ignored), bound + kTie);
  });
}

TEST_P(RandomDuals, AreConcaveAlongSegments) {
  for_random_points(800, [&](const Evaluated& at) {
    std::vector<double> ignored(at.u.size());
    const std::vector<double> w = random_point(at.component, at.function, random_);
    const double end = at.function.evaluate(w, ignored);
    const double t = random_.uniform();
    std::vector<double> between(w.size());
    for (std::size_t j = 0; j < w.size(); ++j) between[j] = (1 - t) * at.u[j] + t * w[j];
    EXPECT_GE(at.function.evaluate(between, ignored), (1 - t) * at.q + t * end - kTie);
  });
}

// Duals of the assignment for the kept dimensions, min(0, u) for the others: all that can be
// negative is the reduced cost of arcs in cell (0, 0), and with these counted they prove q(u).
TEST_P(RandomDuals, MultipliersProveTheValueUpToCellZeroZero) {
  for_random_points(800, [](const Evaluated& at) {
    std::vector<double> all(at.component.num_slots(), 99.0);
    at.function.multipliers(all);
    double proven = sum_of(all);
    for (ArcId a = 0; a < at.component.num_arcs(); ++a) {
      const double r = core::reduced_cost(at.component, all, a);
      if (at.component.index(0, a) == 0 && at.component.index(1, a) == 0) {
        proven += std::min(0.0, r);
      } else {
        EXPECT_GE(r, -kTie);
      }
    }
    EXPECT_GE(proven, at.q - kTie);
    for (std::uint32_t slot = 0; slot < all.size(); ++slot) {
      EXPECT_LE(all[slot], kTie);
      if (is_dummy(at.component, slot)) {
        EXPECT_EQ(all[slot], 0);
      } else if (slot >= at.function.first_slot()) {
        EXPECT_EQ(all[slot], std::min(0.0, at.u[slot - at.function.first_slot()]));
      }
    }
  });
}

std::string name_of(const ::testing::TestParamInfo<Assign2dMethod>& tested) {
  const char* const names[] = {"ShortestPath", "Auction", "NetworkSimplex"};
  return names[static_cast<int>(tested.param)];
}

INSTANTIATE_TEST_SUITE_P(Methods, RandomDuals, ::testing::ValuesIn(kMethods), name_of);

TEST(DualFunction, HasTheSameValueForEveryAssignmentMethod) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const Component component = support::random_component_of_any_kind(seed);
    DualFunction reference(component);
    const std::vector<double> u = random_point(component, reference, random);
    std::vector<double> g(u.size());
    const double q = reference.evaluate(u, g);
    for (const Assign2dMethod method : kMethods) {
      DualFunction other(component, method);
      EXPECT_NEAR(other.evaluate(u, g), q, kTie);
    }
  }
}

TEST(DualFunction, OfTwoDimensionsIsTheOptimum) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE(seed);
    support::RandomComponentOptions options;
    options.sizes = {1 + static_cast<Index>(seed % 5), 1 + static_cast<Index>(seed % 7 / 2)};
    options.dummy_share = 0;
    options.positive_share = 0.3;
    const Component component = support::random_component(seed, options);
    DualFunction function(component);
    EXPECT_EQ(function.num_variables(), 0u);
    EXPECT_NEAR(function.evaluate({}, {}), support::best_cost(component), kTie);
  }
}

// zero_zero_cell: whoever counts the cell (0, 0) once believes in -4.
TEST(DualFunction, UsesTheCellOfTwoDummiesAsOftenAsItPays) {
  const Component component = support::whole_component(support::zero_zero_cell().problem);
  DualFunction function(component);
  std::vector<double> u(function.num_variables(), 0.0);
  std::vector<double> g(u.size());
  // Arcs (0,0,1,1) -2, (0,0,2,2) -3, (1,0,2,1) -1, (1,1,1,2) -4: all but the third are chosen.
  EXPECT_EQ(function.evaluate(u, g), -9);
  EXPECT_THAT(function.chosen_arcs(), ::testing::UnorderedElementsAre(0, 1, 3));
  EXPECT_EQ(function.aligned_cells().size(), 1u);
  // Slots of dimension 2: dummy 1 2, of dimension 3: dummy 1 2.  Index 1 of dimension 2 is used by
  // arcs 0 and 3, 2 by arc 1; of dimension 3: 1 by arc 0, 2 by arcs 1 and 3.
  EXPECT_THAT(g, ElementsAre(0, -1, 0, 0, 0, -1));
}

TEST(DualFunction, AllocatesNothingAfterTheFirstEvaluation) {
  for (const Assign2dMethod method : {Assign2dMethod::kShortestPath, Assign2dMethod::kAuction}) {
    support::RandomComponentOptions options;
    options.sizes = {20, 20, 20};
    options.num_arcs = 400;
    const Component component = support::random_component(1, options);
    DualFunction function(component, method);
    core::Random random(1);
    std::vector<std::vector<double>> points;
    for (int i = 0; i < 20; ++i) points.push_back(random_point(component, function, random));
    std::vector<double> g(function.num_variables());
    for (const std::vector<double>& u : points) function.evaluate(u, g);
    EXPECT_EQ(support::count_allocations([&] {
                for (const std::vector<double>& u : points) function.evaluate(u, g);
              }),
              0u);
  }
}

// 400 x 400 pairs: more than an assignment looks at before it asks for the time.
TEST(DualFunction, IsFiniteWhereTheDeadlineStrikes) {
  Component component = core::make_component({400, 400, 2});
  for (Index i = 1; i <= 400; ++i) {
    for (Index j = 1; j <= 400; ++j) {
      core::append_arc(component, std::vector<Index>{i, j, 1 + (i + j) % 2}, -1.0 * i * j);
    }
  }
  for (const Assign2dMethod method : kMethods) {
    DualFunction function(component, method, core::Deadline(1e-9));
    std::vector<double> u(function.num_variables(), -1.0);
    u[0] = 0;
    std::vector<double> subgradient(u.size());
    EXPECT_TRUE(std::isfinite(function.evaluate(u, subgradient)));
    EXPECT_EQ(function.interrupted(), method != Assign2dMethod::kNetworkSimplex);
    std::vector<double> all(component.num_slots());
    function.multipliers(all);
    EXPECT_TRUE(std::all_of(all.begin(), all.end(), [](double x) { return std::isfinite(x); }));
    EXPECT_TRUE(std::isfinite(make_feasible(component, all)));
  }
}

TEST(MakeFeasible, RepairsAndNeverLowersWhatIsFeasible) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const Component component = support::random_component_of_any_kind(seed);
    std::vector<double> u = support::feasible_multipliers(component, random, 3);
    const double before = sum_of(u);
    const double lower = make_feasible(component, u);
    EXPECT_EQ(support::multiplier_fault(component, u), "");
    EXPECT_DOUBLE_EQ(lower, sum_of(u));
    EXPECT_GE(lower, before - kTie);
    EXPECT_LE(lower, support::best_cost(component) + kTie);
  }
}

// Of any multipliers, its bound is the certificate's or better: sum u + sum of min(0, r) over arcs
// and singletons.
TEST(MakeFeasible, NeverLowersTheBoundOfAnyMultipliers) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const Component component = support::random_component_of_any_kind(seed);
    std::vector<double> u(component.num_slots());
    for (double& multiplier : u) multiplier = random.uniform(-12, 4);
    for (const std::uint32_t dummy : component.offset) u[dummy] = 0;
    double certificate = 0;
    for (const double multiplier : u) certificate += std::min(0.0, multiplier);
    for (ArcId a = 0; a < component.num_arcs(); ++a) {
      certificate += std::min(0.0, core::reduced_cost(component, u, a));
    }
    const double lower = make_feasible(component, u);
    EXPECT_EQ(support::multiplier_fault(component, u), "");
    EXPECT_GE(lower, certificate - kTie);
    EXPECT_LE(lower, support::best_cost(component) + kTie);
  }
}

TEST(MakeFeasible, ProvesTheDualValueOrMore) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const Component component = support::random_component_of_any_kind(seed);
    DualFunction function(component);
    const std::vector<double> u = random_point(component, function, random);
    std::vector<double> g(u.size());
    const double q = function.evaluate(u, g);
    std::vector<double> all(component.num_slots());
    function.multipliers(all);
    EXPECT_GE(make_feasible(component, all), q - kTie);
  }
}

TEST(MakeFeasible, UsesSlack) {
  // (1,1) -5 with u = -4 -4: the last dimension is raised to -1.
  Component component = core::make_component({1, 1});
  core::append_arc(component, std::vector<Index>{1, 1}, -5);
  std::vector<double> u = {0, -4, 0, -4};
  EXPECT_EQ(make_feasible(component, u), -5);
  EXPECT_THAT(u, ElementsAre(0, -4, 0, -1));
}

}  // namespace
}  // namespace nda::relax
