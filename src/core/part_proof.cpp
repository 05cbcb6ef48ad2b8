#include "core/part_proof.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>

#include "core/certificate_sum.hpp"
#include "core/double_double.hpp"
#include "core/nested_set.hpp"
#include "core/proof_cliques.hpp"
#include "core/proof_grid.hpp"
#include "core/proof_search.hpp"

// A proof is followed step by step: which indices are left, which arcs and which singletons are
// still allowed is the state, every step returns a bound on what the allowed ones can do with the
// indices left.  Allowed arcs use none but these.  Nothing in the file is believed but multipliers,
// cuts and thresholds, and these may be any numbers: worse ones prove less.  Rounding is always
// against the proof.

namespace nda::core {
namespace {

constexpr std::uint32_t kNowhere = std::numeric_limits<std::uint32_t>::max();
constexpr double kMostSearchWork = 2e10;  // of all searches of a part: some minutes
// Sums of so few terms in double-double err by less than this share of their absolute values.
constexpr double kShare = 0x1p-90;

// Follows the steps of one part.
class PartProof {
 public:
  PartProof(const PartArcs& arcs,
            const std::vector<double>& singletons,
            double grid,
            const std::vector<ProofStep>& steps)
      : arcs_(arcs),
        singletons_(singletons),
        grid_(grid, arcs, singletons),
        steps_(steps),
        arcs_at_(singletons.size()),
        allowed_(arcs.size()),
        left_(singletons.size()),
        singleton_excluded_(singletons.size(), 0),
        group_(singletons.size(), kNowhere),
        row_(singletons.size(), 0),
        number_(arcs.size(), kNowhere),
        weight_(singletons.size(), 0),
        multipliers_(singletons.size(), 0.0),
        reduced_(arcs.size()),
        size_(arcs.size(), 0.0) {
    for (std::uint32_t a = 0; a < arcs.size(); ++a)
      arcs.for_each_position(a, [&](std::uint32_t p) { arcs_at_[p].push_back(a); });
  }

  double bound() {
    const double value = grid_.rounded_up(follow(), singletons_.size());
    if (next_ < steps_.size()) fault("steps are left over");
    return value;
  }

 private:
  [[noreturn]] void fault(const std::string& text) const {
    throw ProofFault{"step " + std::to_string(next_) + ": " + text};
  }

  // Chains of fixings are walked in a loop; only branchings nest, and what they do not pass through
  // is kept out of their frames.
  double follow() {
    const NestedSet::Range before = allowed_.range();
    double least = kInfinity;
    for (;;) {
      if (next_ == steps_.size()) fault("the tree has no end");
      const ProofStep& step = steps_[next_++];
      if (step.rule == ProofRule::kFix) {
        if (fix(step)) least = std::min(least, step.threshold);
        continue;
      }
      least = std::min(least, value_of(step));
      allowed_.set_range(before);
      return least;
    }
  }

  double value_of(const ProofStep& step) {
    if (step.rule == ProofRule::kBound) return price(step.point);
    if (step.rule == ProofRule::kSearch) return search(step);
    if (step.rule == ProofRule::kCliques) return cliques(step);
    if (++depth_ > kMostProofBranchings) fault("the tree is too deep");
    const double value = step.rule == ProofRule::kCover   ? cover(step)
                         : step.rule == ProofRule::kSplit ? split(step)
                                                          : branch(step);
    --depth_;
    return value;
  }

  bool may_stay_alone(std::uint32_t position) const {
    return singleton_excluded_[position] == 0 && singletons_[position] < kInfinity;
  }

  void take_multipliers(const ProofPoint& point) {
    for (const auto [position, value] : point.changes) {
      if (position >= multipliers_.size()) fault("a multiplier is of an index out of range");
      if (!std::isfinite(value)) fault("a multiplier is not finite");
      multipliers_[position] = value;
    }
  }

  void check_cut(const ProofCut& cut) const {
    if (cut.positions.size() != cut.weights.size()) fault("a cut has not one weight an index");
    if (cut.divisor == 0) fault("a cut has divisor 0");
    if (!(cut.multiplier <= 0) || !std::isfinite(cut.multiplier))
      fault("the multiplier of a cut is not finite and <= 0");
    std::vector<std::uint32_t> sorted = cut.positions;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      fault("a cut is over the same index twice");
    if (!sorted.empty() && sorted.back() >= singletons_.size())
      fault("a cut is over an index out of range");
  }

  // Reduced costs of all allowed arcs into reduced_, and the bound of the point: of packings
  // without arcs, or of all.
  [[gnu::noinline]] double price(const ProofPoint& point, bool any_arcs = true) {
    take_multipliers(point);
    CertificateSum sum;
    double terms = 6;
    start_reduced();
    for (const ProofCut& cut : point.cuts) terms += subtract(cut, sum);
    for (const std::uint32_t p : left_.members()) {
      const double y = multipliers_[p];
      sum.add(p, y);
      if (may_stay_alone(p) && singletons_[p] < y) {
        sum.add(p, singletons_[p]);
        sum.add(p, -y);
      }
    }
    for (const std::uint32_t a : allowed_.members()) {
      sum.enlarge(size_[a]);
      terms += static_cast<double>(arcs_.start[a + 1] - arcs_.start[a]) + 3;
      if (!any_arcs || !reduced_[a].negative()) continue;
      sum.add(a, reduced_[a].high());
      sum.add(a, reduced_[a].low());
    }
    return sum.rounded_down(terms + 3 * static_cast<double>(left_.members().size()));
  }

  void start_reduced() {
    for (const std::uint32_t a : allowed_.members()) {
      reduced_[a] = DoubleDouble(arcs_.cost[a]);
      size_[a] = std::abs(arcs_.cost[a]);
      arcs_.for_each_position(a, [&](std::uint32_t p) {
        reduced_[a].add(-multipliers_[p]);
        size_[a] += std::abs(multipliers_[p]);
      });
    }
  }

  // Takes a cut out of the reduced costs; returns how many terms that were.
  double subtract(const ProofCut& cut, CertificateSum& sum) {
    check_cut(cut);
    double terms = 0;
    for (int n = 0; n < right_side(cut); ++n, ++terms)
      sum.add(static_cast<std::size_t>(n), cut.multiplier);
    for_each_coefficient(cut, [&](std::uint32_t a, int coefficient) {
      for (int n = 0; n < coefficient; ++n, ++terms) reduced_[a].add(-cut.multiplier);
      size_[a] += coefficient * std::abs(cut.multiplier);
    });
    return terms;
  }

  static int right_side(const ProofCut& cut) {
    return std::accumulate(cut.weights.begin(), cut.weights.end(), 0) / cut.divisor;
  }

  // Calls visit(arc, coefficient) for all allowed arcs with a coefficient in the cut.
  template <typename Visit>
  void for_each_coefficient(const ProofCut& cut, Visit&& visit) {
    for (std::size_t i = 0; i < cut.positions.size(); ++i)
      weight_[cut.positions[i]] = cut.weights[i];
    for (const std::uint32_t position : cut.positions) {
      for (const std::uint32_t a : arcs_at_[position]) {
        const int coefficient =
            allowed_.contains(a) ? coefficient_at(a, position) / cut.divisor : 0;
        if (coefficient > 0) visit(a, coefficient);
      }
    }
    for (const std::uint32_t position : cut.positions) weight_[position] = 0;
  }

  // The weight of an arc, at the first of its positions that has one; 0 at the others.
  int coefficient_at(std::uint32_t a, std::uint32_t position) const {
    int total = 0;
    bool first = true;
    arcs_.for_each_position(a, [&](std::uint32_t p) {
      if (total == 0 && weight_[p] > 0) first = p == position;
      total += weight_[p];
    });
    return first ? total : 0;
  }

  // value + the reduced cost of an arc, rounded down.
  double with_arc(double value, std::uint32_t a) const {
    DoubleDouble sum(value);
    sum.add(reduced_[a].high());
    sum.add(reduced_[a].low());
    sum.add(-kShare * size_[a]);
    return std::nextafter(sum.high(), -kInfinity);
  }

  // Forbids arcs; returns whether there were any.
  [[gnu::noinline]] bool fix(const ProofStep& step) {
    const double value = price(step.point);
    const std::size_t before = allowed_.members().size();
    allowed_.keep_if([&](std::uint32_t a) {
      return reduced_[a].negative() || !(with_arc(value, a) >= step.threshold);
    });
    return allowed_.members().size() < before;
  }

  double branch(const ProofStep& step) {
    if (step.first >= singletons_.size() || step.second >= singletons_.size() ||
        step.first == step.second)
      fault("branching on indices that are no pair");
    double least = kInfinity;
    const NestedSet::Range before = allowed_.range();
    const bool together_first = step.rule == ProofRule::kTogether;
    for (const bool together : {together_first, !together_first}) {
      keep_pair(step.first, step.second, together);
      singleton_excluded_[step.first] += together;
      singleton_excluded_[step.second] += together;
      least = std::min(least, follow());
      singleton_excluded_[step.first] -= together;
      singleton_excluded_[step.second] -= together;
      allowed_.set_range(before);
    }
    return least;
  }

  // Forbids arcs that use exactly one of the two indices, or those that use both.
  [[gnu::noinline]] void keep_pair(std::uint32_t first, std::uint32_t second, bool together) {
    allowed_.keep_if([&](std::uint32_t a) {
      const int uses = (arcs_.uses(a, first) ? 1 : 0) + (arcs_.uses(a, second) ? 1 : 0);
      return uses == 0 || together == (uses == 2);
    });
  }

  // The index is used in exactly one way: one of those listed, or another.
  double cover(const ProofStep& step) {
    if (step.first >= singletons_.size() || !left_.contains(step.first))
      fault("branching on an index that is not left");
    double least = kInfinity;
    const NestedSet::Range before = allowed_.range();
    const auto is_forbidden = singleton_excluded_[step.first];
    for (const std::uint32_t number : step.uses) {
      least = std::min(least, number == 0 ? alone(step.first) : with(arc_at(number, step.first)));
      forbid(number, step.first);
    }
    least = std::min(least, follow());
    allowed_.set_range(before);
    singleton_excluded_[step.first] = is_forbidden;
    return least;
  }

  // The arc of this number in the problem.
  std::uint32_t arc_at(std::uint32_t number, std::uint32_t position) const {
    const auto found = std::lower_bound(arcs_.number.begin(), arcs_.number.end(), number);
    const auto a = static_cast<std::uint32_t>(found - arcs_.number.begin());
    if (found == arcs_.number.end() || *found != number || !arcs_.uses(a, position))
      fault("arc " + std::to_string(number) + " does not use the index");
    return a;
  }

  [[gnu::noinline]] void forbid(std::uint32_t number, std::uint32_t position) {
    if (number == 0) {
      ++singleton_excluded_[position];
    } else {
      allowed_.keep_if([&](std::uint32_t a) { return arcs_.number[a] != number; });
    }
  }

  // What remains when the index stays alone; nothing does where it must not.
  double alone(std::uint32_t position) {
    const double cost = may_stay_alone(position) ? singletons_[position] : kInfinity;
    return done_with({&position, 1}, cost);
  }

  // What remains when the arc is used; nothing does where it is forbidden.
  double with(std::uint32_t a) {
    const std::span<const std::uint32_t> positions(arcs_.positions);
    return done_with(positions.subspan(arcs_.start[a], arcs_.start[a + 1] - arcs_.start[a]),
                     allowed_.contains(a) ? arcs_.cost[a] : kInfinity);
  }

  // A bound on `cost` and what is left without these indices.
  double done_with(std::span<const std::uint32_t> positions, double cost) {
    const NestedSet::Range arcs = allowed_.range();
    const NestedSet::Range indices = left_.range();
    leave_out(positions);
    const double rest = follow();
    allowed_.set_range(arcs);
    left_.set_range(indices);
    return cost < kInfinity ? below(cost + rest) : kInfinity;
  }

  [[gnu::noinline]] void leave_out(std::span<const std::uint32_t> positions) {
    for (const std::uint32_t p : positions) weight_[p] = 1;
    left_.keep_if([&](std::uint32_t p) { return weight_[p] == 0; });
    allowed_.keep_if([&](std::uint32_t a) {
      bool meets = false;
      arcs_.for_each_position(a, [&](std::uint32_t p) { meets = meets || weight_[p] != 0; });
      return !meets;
    });
    for (const std::uint32_t p : positions) weight_[p] = 0;
  }

  // What the groups cost adds up, as no arc connects them.
  double split(const ProofStep& step) {
    const NestedSet::Range arcs = allowed_.range();
    const NestedSet::Range indices = left_.range();
    double sum = 0;
    for (const auto& [arcs_of_group, indices_of_group] : divide(step)) {
      allowed_.set_range(arcs_of_group);
      left_.set_range(indices_of_group);
      sum = below(sum + grid_.rounded_up(follow(), left_.members().size()));
    }
    allowed_.set_range(arcs);
    left_.set_range(indices);
    return sum;
  }

  struct Group {
    NestedSet::Range arcs;
    NestedSet::Range indices;
  };

  // The groups, and then what is in none.
  [[gnu::noinline]] std::vector<Group> divide(const ProofStep& step) {
    const auto rest = static_cast<std::uint32_t>(step.groups.size());
    for (const std::uint32_t p : left_.members()) group_[p] = rest;
    for (std::uint32_t g = 0; g < rest; ++g) enter_group(step.groups[g], g, rest);
    const auto group_of = [&](std::uint32_t a) { return group_[arcs_.positions[arcs_.start[a]]]; };
    for (const std::uint32_t a : allowed_.members()) {
      arcs_.for_each_position(a, [&](std::uint32_t p) {
        if (group_[p] != group_of(a))
          fault("arc " + std::to_string(arcs_.number[a]) + " connects two groups");
      });
    }
    const auto arcs = allowed_.divide(rest + std::size_t{1}, group_of);
    const auto indices =
        left_.divide(rest + std::size_t{1}, [&](std::uint32_t p) { return group_[p]; });
    std::vector<Group> groups;
    for (std::size_t g = 0; g <= rest; ++g) groups.push_back({arcs[g], indices[g]});
    return groups;
  }

  void enter_group(const std::vector<std::uint32_t>& positions,
                   std::uint32_t group,
                   std::uint32_t rest) {
    for (const std::uint32_t p : positions) {
      if (p >= singletons_.size() || !left_.contains(p) || group_[p] != rest)
        fault("a group has an index that is not left, or in another group");
      group_[p] = group;
    }
  }

  // The least bound of what a search finds below the threshold, or the threshold.
  [[gnu::noinline]] double search(const ProofStep& step) {
    if (!std::isfinite(step.threshold)) fault("a search without a finite threshold");
    const double value = price(step.point);
    if (value >= step.threshold) return step.threshold;
    const double budget = std::nextafter(step.threshold - value, kInfinity);
    if (!std::isfinite(budget)) return value;
    try {
      const double rise =
          least_rise(search_task(step.point, budget), budget, work_, kMostSearchWork);
      return std::min(step.threshold, std::nextafter(value + rise, -kInfinity));
    } catch (const ProofFault& problem) {
      fault(problem.text);
    }
  }

  // Its rows are the indices left, then the cuts.
  SearchTask search_task(const ProofPoint& point, double budget) {
    SearchTask task;
    for (const std::uint32_t p : left_.members()) {
      row_[p] = task.num_indices++;
      const double rise = singletons_[p] - multipliers_[p];
      task.rows.push_back({may_stay_alone(p) ? std::max(0.0, below(rise)) : kInfinity, 1});
    }
    for (const std::uint32_t a : sorted_arcs()) {
      const double rise = std::max(0.0, with_arc(0.0, a));
      number_[a] = rise < budget ? static_cast<std::uint32_t>(task.rise.size()) : kNowhere;
      if (number_[a] == kNowhere) continue;
      task.rise.push_back(rise);
      task.entries.emplace_back();
      arcs_.for_each_position(a, [&](std::uint32_t p) {
        task.entries.back().push_back({row_[p], 1});
      });
    }
    for (const ProofCut& cut : point.cuts) add_row(cut, task);
    return task;
  }

  std::vector<std::uint32_t> sorted_arcs() const {
    std::vector<std::uint32_t> sorted(allowed_.members().begin(), allowed_.members().end());
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }

  void add_row(const ProofCut& cut, SearchTask& task) {
    const auto row = static_cast<std::uint32_t>(task.rows.size());
    task.rows.push_back({-cut.multiplier, static_cast<std::uint32_t>(right_side(cut))});
    for_each_coefficient(cut, [&](std::uint32_t a, int coefficient) {
      if (number_[a] != kNowhere)
        task.entries[number_[a]].push_back({row, static_cast<std::uint32_t>(coefficient)});
    });
  }

  // The same for a search that reckons with arcs alone, whatever the point is.
  [[gnu::noinline]] double cliques(const ProofStep& step) {
    if (!std::isfinite(step.threshold)) fault("a search without a finite threshold");
    const double value = price(step.point, false);
    CliqueTask task;
    for (const std::uint32_t a : sorted_arcs()) {
      const double gain = -with_arc(0.0, a);
      if (gain <= 0) continue;
      task.gain.push_back(gain);
      task.indices.emplace_back();
      arcs_.for_each_position(a, [&](std::uint32_t p) { task.indices.back().push_back(p); });
    }
    const double target = below(value - step.threshold);
    try {
      const double most = most_gain(task, target, work_, kMostSearchWork);
      return most > target ? below(value - most) : step.threshold;
    } catch (const ProofFault& problem) {
      fault(problem.text);
    }
  }

  static double below(double value) { return std::nextafter(value, -kInfinity); }

  const PartArcs& arcs_;
  const std::vector<double>& singletons_;  // by position
  const ProofGrid grid_;
  const std::vector<ProofStep>& steps_;
  std::size_t next_ = 0;
  int depth_ = 0;
  std::vector<std::vector<std::uint32_t>> arcs_at_;  // by position
  NestedSet allowed_;                                // arcs
  NestedSet left_;                                   // positions
  std::vector<std::uint32_t> singleton_excluded_;    // by position: how often
  std::vector<std::uint32_t> group_;                 // by position: in the division at hand
  std::vector<std::uint32_t> row_;                   // by position: in the search at hand
  std::vector<std::uint32_t> number_;                // by arc: in the search at hand
  std::vector<int> weight_;                          // by position: of the cut at hand, else 0
  std::vector<double> multipliers_;                  // by position
  std::vector<DoubleDouble> reduced_;                // by arc
  std::vector<double> size_;                         // by arc: of the terms of its reduced cost
  // Of all searches.
  double work_ = 0;
};

}  // namespace

double part_bound(const PartArcs& arcs,
                  const std::vector<double>& singletons,
                  double grid,
                  const std::vector<ProofStep>& steps) {
  return PartProof(arcs, singletons, grid, steps).bound();
}

}  // namespace nda::core
