#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "cutting/cutting_support.hpp"
#include "cutting/tree_search.hpp"
#include "nda/check.hpp"
#include "nda/io.hpp"
#include "nda/solve.hpp"
#include "solve/branched_proofs.hpp"
#include "solve/proven_problems.hpp"
#include "support/components.hpp"

// What becomes of right proofs when a number is changed.  The file is refused by its digest,
// whatever was changed; under a digest that is right for the change, checking either fails or shows
// a bound that is true all the same.

namespace nda {
namespace {

struct Proven {
  Problem problem;
  Solution solution;
};

// A component of a dozen indices and the problem of its arcs, whose singletons are free, proven by
// what write(component, cutoff, log) writes down.
template <typename Write>
Proven proven_component(std::uint64_t seed, Write&& write) {
  const core::Component component = cutting::fractional_component(seed);
  Problem problem = support::to_problem(component);
  Solution solution = solve(problem, plain());
  bnb::ProofLog log(component, cutting::no_multipliers(component), 1e-10);
  write(component, solution.cost - 1e-9, log);
  solution.proof->parts = {log.take()};
  return {std::move(problem), std::move(solution)};
}

// Trees with cuts, which end to end only large problems have: nothing ends their nodes sooner.
void write_tree(const core::Component& component, double cutoff, bnb::ProofLog& log) {
  cutting::Master master(component, core::all_arcs(component), cutting::no_multipliers(component));
  cutting::BranchAndCutLimits limits;
  limits.max_nodes = 1000000;
  limits.root_rounds = limits.node_rounds = 1 + static_cast<int>(component.num_arcs() % 3);
  limits.leaf_work = 0;
  limits.margin = 1e-9;
  limits.context.proof = &log;
  cutting::search_tree(
      component, master, cutoff, limits, [cutoff](const auto&, const auto*) { return cutoff; });
}

// Trees that branch on indices and fall apart.
void write_index_tree(const core::Component& component, double cutoff, bnb::ProofLog& log) {
  std::vector<core::ArcId> negative;
  for (core::ArcId a = 0; a < component.num_arcs(); ++a) {
    if (component.costs[a] < 0) negative.push_back(a);
  }
  const core::Component worthwhile = core::Cutter().cut(component, negative);
  std::vector<double> u(worthwhile.num_slots(), 0.0);
  relax::make_feasible(worthwhile, u, {});
  bnb::BranchLimits limits;
  limits.enumeration_arcs = component.num_arcs() % 3;
  limits.margin = limits.error = 1e-9;
  limits.proof = &log;
  bnb::branch_and_bound(worthwhile, u, cutoff, ascending(), limits);
}

void write_cover(const core::Component&, double cutoff, bnb::ProofLog& log) {
  log.cliques({}, cutoff);
}

// Between them they have steps of every kind, and cuts.
const std::vector<Proven>& proven_problems() {
  static const std::vector<Proven> all = [] {
    std::vector<Proven> proven;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      Problem problem = gapped_problem(seed);
      Solution solution = solve(problem, branching());
      if (!solution.proof->parts.empty())
        proven.push_back({std::move(problem), std::move(solution)});
    }
    for (std::uint64_t seed = 0; seed < 60; ++seed)
      proven.push_back(proven_component(seed, write_cover));
    const auto add_tree = [&](Proven tree) {
      if (tree.solution.proof->parts[0].steps.size() > 1) proven.push_back(std::move(tree));
    };
    for (std::uint64_t seed = 0; seed < 1500; ++seed) add_tree(proven_component(seed, write_tree));
    for (std::uint64_t seed = 0; seed < 400; ++seed)
      add_tree(proven_component(seed, write_index_tree));
    return proven;
  }();
  return all;
}

TEST(ChangedProof, WasRightBefore) {
  std::map<ProofRule, int> num_steps;
  std::size_t num_cuts = 0;
  for (const auto& [problem, solution] : proven_problems()) {
    const CheckReport report = check(problem, solution, *solution.proof);
    ASSERT_TRUE(report.passed()) << report.faults.front();
    for (const ProofPart& part : solution.proof->parts) {
      for (const ProofStep& step : part.steps) {
        ++num_steps[step.rule];
        num_cuts += step.point.cuts.size();
      }
    }
  }
  ASSERT_EQ(num_steps.size(), 8) << "rules";
  for (const auto& [rule, count] : num_steps) EXPECT_GT(count, 25) << static_cast<int>(rule);
  EXPECT_GT(num_cuts, 500);
}

// What can be changed in a proof.
enum class Place {
  kStep,        // one is left out
  kThreshold,   // of a fixing, a search or a cover by cliques
  kMultiplier,  // its value
  kPosition,    // whose multiplier it is
  kLostCut,
  kWeight,
  kDivisor,
  kCutMultiplier,
  kCutPosition,
  kBranching,  // together for apart, or its indices
  kUse,        // of an index that is branched on: one is left out, or another takes its place
  kGroup,      // an index changes the group
  kIndex,      // of the part
  kGrid,
};
constexpr int kNumPlaces = static_cast<int>(Place::kGrid) + 1;

bool has_threshold(ProofRule rule) {
  return rule == ProofRule::kFix || rule == ProofRule::kSearch || rule == ProofRule::kCliques;
}

bool is_branching(ProofRule rule) {
  return rule == ProofRule::kTogether || rule == ProofRule::kApart;
}

// Another number, greater or less.
double other(double value, core::Random& random) {
  return value + (random.below(2) == 0 ? -1 : 1) * std::pow(10, random.uniform(-6, 1));
}

// To another index; false where there is none.
bool move(std::uint32_t& position, std::size_t width, core::Random& random) {
  if (width < 2) return false;
  position = static_cast<std::uint32_t>((position + 1 + random.below(width - 1)) % width);
  return true;
}

// Another use of the index, that arc or none; or one fewer.
bool mutate_uses(ProofStep& step, std::size_t num_arcs, core::Random& random) {
  if (step.rule != ProofRule::kCover || step.uses.empty()) return false;
  std::uint32_t& use = step.uses[random.below(step.uses.size())];
  switch (random.below(3)) {
    case 0:
      step.uses.pop_back();
      return true;
    case 1:
      use = use == 0 ? 1 : 0;
      return true;
    default:
      use = static_cast<std::uint32_t>((use + 1 + random.below(num_arcs)) % (num_arcs + 1));
      return true;
  }
}

// An index leaves its group, or the group loses its last.
bool mutate_group(ProofStep& step, std::size_t width, core::Random& random) {
  if (step.rule != ProofRule::kSplit || step.groups.empty()) return false;
  std::vector<std::uint32_t>& group = step.groups[random.below(step.groups.size())];
  if (random.below(2) == 0) return move(group[random.below(group.size())], width, random);
  group.erase(group.begin() + static_cast<std::ptrdiff_t>(random.below(group.size())));
  return true;
}

bool mutate_cut(std::vector<ProofCut>& cuts, Place place, std::size_t width, core::Random& random) {
  if (cuts.empty()) return false;
  ProofCut& cut = cuts[random.below(cuts.size())];
  const std::size_t n = random.below(cut.positions.size());
  switch (place) {
    case Place::kLostCut:
      cuts.pop_back();
      return true;
    case Place::kWeight:
      ++cut.weights[n];
      return true;
    case Place::kDivisor:
      cut.divisor = static_cast<std::uint8_t>(1 + (cut.divisor + random.below(5)) % 6);
      return true;
    case Place::kCutMultiplier:
      cut.multiplier = other(cut.multiplier, random);
      return true;
    default:
      return move(cut.positions[n], width, random);
  }
}

// Changes a proof in one place; returns false where nothing was there to be changed.
bool mutate(Proof& proof, Place place, core::Random& random) {
  ProofPart& part = proof.parts[random.below(proof.parts.size())];
  const std::size_t at = random.below(part.steps.size());
  ProofStep& step = part.steps[at];
  std::vector<ProofMultiplier>& changes = step.point.changes;
  const std::size_t width = part.indices.size();
  switch (place) {
    case Place::kStep:
      part.steps.erase(part.steps.begin() + static_cast<std::ptrdiff_t>(at));
      return true;
    case Place::kThreshold:
      step.threshold = other(step.threshold, random);
      return has_threshold(step.rule);
    case Place::kMultiplier:
      if (changes.empty()) return false;
      changes[random.below(changes.size())].value += random.uniform(-9, 9);
      return true;
    case Place::kPosition:
      if (changes.empty()) return false;
      return move(changes[random.below(changes.size())].position, width, random);
    case Place::kBranching:
      if (step.rule == ProofRule::kCover) return move(step.first, width, random);
      if (!is_branching(step.rule)) return false;
      if (random.below(2) == 0) return move(step.second, width, random);
      step.rule = step.rule == ProofRule::kTogether ? ProofRule::kApart : ProofRule::kTogether;
      return true;
    case Place::kUse:
      return mutate_uses(step, proof.num_arcs, random);
    case Place::kGroup:
      return mutate_group(step, width, random);
    case Place::kIndex:
      part.indices.erase(part.indices.begin() + static_cast<std::ptrdiff_t>(random.below(width)));
      return true;
    case Place::kGrid:
      proof.grid = proof.grid == 0 ? 1 : proof.grid * 10;
      return true;
    default:
      return mutate_cut(step.point.cuts, place, width, random);
  }
}

// Every proof changed a few times in every place it has: change(proven, changed, place).
template <typename Visit>
void for_changed_proofs(std::uint64_t seed, int trials, Visit&& visit) {
  core::Random random(seed);
  for (int place = 0; place < kNumPlaces; ++place) {
    SCOPED_TRACE(place);
    for (const Proven& proven : proven_problems()) {
      for (int trial = 0; trial < trials; ++trial) {
        Proof changed = *proven.solution.proof;
        if (mutate(changed, static_cast<Place>(place), random)) visit(proven, changed, place);
        if (::testing::Test::HasFailure()) return;
      }
    }
  }
}

// A changed proof fails, or falls short, or is a proof all the same: never does it show too much.
TEST(ChangedProof, ShowsNothingWrong) {
  int num_changed[kNumPlaces] = {}, num_refused[kNumPlaces] = {};
  for_changed_proofs(1, 6, [&](const Proven& proven, const Proof& changed, int place) {
    const auto& [problem, solution] = proven;
    const CheckReport report = check(problem, solution, changed);
    EXPECT_LE(report.proof_bound, solution.cost + 1e-12 * std::abs(solution.cost));
    ++num_changed[place];
    num_refused[place] += !report.passed();
  });
  for (int place = 0; place < kNumPlaces; ++place) {
    SCOPED_TRACE(place);
    EXPECT_GT(num_changed[place], 80);
    EXPECT_GT(num_refused[place], num_changed[place] / 4);
  }
}

// Not by an accident of the text: the numbers of one proof under the digest of another.
TEST(ChangedProof, IsRefusedUnderTheDigestOfAnother) {
  const auto text_of = [](const Proof& proof) {
    std::ostringstream text;
    write_proof(proof, text);
    return text.str();
  };
  int num_changed = 0;
  for_changed_proofs(3, 1, [&](const Proven& proven, const Proof& changed, int) {
    const std::string right = text_of(*proven.solution.proof);
    const std::string wrong = text_of(changed);
    EXPECT_EQ(text_of(parse_proof(right)), right);
    EXPECT_THROW(
        parse_proof(wrong.substr(0, wrong.rfind("end")) + right.substr(right.rfind("end"))),
        InputError)
        << wrong;
    ++num_changed;
  });
  EXPECT_GT(num_changed, 2000);
}

}  // namespace
}  // namespace nda
