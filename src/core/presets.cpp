#include <array>
#include <iterator>
#include <span>
#include <string>

#include "nda/options.hpp"

// The classic algorithms as settings of one engine: each preset of a paper names every option that
// its algorithm depends on, so that a default may change and the preset does not.  What the papers
// leave open (steps, tolerances) is chosen here once; docs/presets.md tells which is which.

namespace nda {
namespace {

// Everything kept that can be.
constexpr int kAllButOne = 64;
// Larger than any number of evaluations: recovery at the end only.
constexpr int kAtTheEnd = 1000000;
constexpr int kStepsOf1995 = 10;
constexpr int kStepsOf1993 = 50;
constexpr int kInnerSteps = 10;
constexpr int kOneStep = 2;  // evaluations: before it and after it
constexpr int kBranchesOfThePaper = 4;
constexpr std::size_t kFewArcs = 5;  // "four or five feasible arcs": by branch and bound

struct Preset {
  PresetInfo info;
  void (*apply)(Options&);
};

void realtime(Options& options) {
  options.time_limit_s = 0.05;
  options.relative_gap = 1e-3;
  options.relaxation.max_evaluations = 60;
}

void exact(Options& options) {
  options.relaxation.max_evaluations = 500;
  options.branch.node_evaluations = 100;
}

// Relaxation and recovery, and nothing else.
void relaxation_alone(Options& options) {
  options.method = Method::kRelaxation;
  options.search = {.reductions = Reductions::kNone,
                    .local_search = false,
                    .dimensionwise = false,
                    .kicks_per_index = 0};
  options.ranking.local_search = false;
  RelaxationOptions& relaxation = options.relaxation;
  relaxation.two_first = false;
  relaxation.set_order = relaxation.recovery_order = SetOrder::kAsGiven;
  relaxation.assign2d = Assign2dMethod::kAuction;
  relaxation.recovery = RecoveryMethod::kRecursive;
  relaxation.recovery_interval = kAtTheEnd;
  relaxation.relative_tolerance = 1e-7;
  relaxation.alignment = AlignmentRule::kBestValue;
  relaxation.inner_evaluations = 0;
}

void poore_rijavec_1993(Options& options) {
  relaxation_alone(options);
  RelaxationOptions& relaxation = options.relaxation;
  relaxation.kept_sets = kAllButOne;
  relaxation.kept_exact_arcs = kFewArcs;
  relaxation.kept_nodes = 1000;
  relaxation.kept_evaluations = kInnerSteps;
  relaxation.merit = true;
  relaxation.decompose = true;
  relaxation.dual_method = DualMethod::kBundleTrust;
  relaxation.max_evaluations = kStepsOf1993;
  relaxation.recovery_evaluations = kInnerSteps;
}

void deb_1992(Options& options) {
  poore_rijavec_1993(options);
  RelaxationOptions& relaxation = options.relaxation;
  relaxation.kept_exact_arcs = 0;
  relaxation.kept_nodes = 0;
  relaxation.merit = false;
  relaxation.decompose = false;
  relaxation.dual_method = DualMethod::kSubgradient;
  relaxation.kept_evaluations = relaxation.recovery_evaluations = kOneStep;
  relaxation.recovery_interval = 1;
}

void poore_1995(Options& options) {
  relaxation_alone(options);
  RelaxationOptions& relaxation = options.relaxation;
  relaxation.kept_sets = 2;
  relaxation.decompose = true;
  relaxation.dual_method = DualMethod::kBundleTrust;
  relaxation.max_evaluations = relaxation.recovery_evaluations = kStepsOf1995;
}

void partial_bnb(Options& options) {
  poore_1995(options);
  options.relaxation.alignment = AlignmentRule::kLeastViolation;
  options.relaxation.inner_evaluations = kInnerSteps;
  options.ranking.method = RankingMethod::kAlignments;
  options.ranking.branches = kBranchesOfThePaper;
}

void murty_bnb(Options& options) {
  partial_bnb(options);
  options.ranking.method = RankingMethod::kMurty;
}

const Preset kPresets[] = {
    {{"default",
      "proven optima: small parts exactly, large ones by all that the engine has",
      false},
     [](Options&) {}},
    {{"realtime", "50 ms, a gap of 0.1 % will do", false}, realtime},
    {{"exact", "more steps before branching, and at every node", false}, exact},
    {{"poore-rijavec-1993",
      "one set relaxed at a time, n to n - 1 to ... to 2, merit function",
      true},
     poore_rijavec_1993},
    {{"deb-1992", "the same with one step at every inner level and no merit function", true},
     deb_1992},
    {{"poore-1995", "all sets but two relaxed, ten steps of bundle trust", true}, poore_1995},
    {{"partial-bnb", "partial branch and bound over index alignments, four at a stage", true},
     partial_bnb},
    {{"murty-bnb", "the same over the four best assignments of the best multipliers", true},
     murty_bnb},
};

const PresetInfo* infos() {
  static const auto list = [] {
    std::array<PresetInfo, std::size(kPresets)> result{};
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = kPresets[i].info;
    return result;
  }();
  return list.data();
}

}  // namespace

std::span<const PresetInfo> presets() {
  return {infos(), std::size(kPresets)};
}

Options preset(const std::string& name) {
  std::string known;
  for (const Preset& line : kPresets) {
    if (name == line.info.name) {
      Options options;
      line.apply(options);
      return options;
    }
    known += std::string(known.empty() ? "" : ", ") + line.info.name;
  }
  throw InputError("preset '" + name + "' is not known; there are " + known);
}

}  // namespace nda
