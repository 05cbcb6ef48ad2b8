#include "core/part_proof.hpp"

#include <cmath>
#include <limits>
#include <numeric>

#include "core/certificate_sum.hpp"
#include "core/double_double.hpp"
#include "core/proof_cliques.hpp"
#include "core/proof_search.hpp"

// A proof is followed step by step: which arcs and which singletons are still allowed is the state,
// every step returns a bound on what the allowed ones can do.  Nothing in the file is believed but
// multipliers, cuts and thresholds, and these may be any numbers: worse ones prove less.  Rounding
// is always against the proof.

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
            std::vector<double> singletons,
            const std::vector<ProofStep>& steps)
      : arcs_(arcs),
        singletons_(std::move(singletons)),
        steps_(steps),
        arcs_at_(singletons_.size()),
        excluded_(arcs.size(), 0),
        singleton_excluded_(singletons_.size(), 0),
        weight_(singletons_.size(), 0),
        multipliers_(singletons_.size(), 0.0) {
    for (std::uint32_t a = 0; a < arcs.size(); ++a)
      arcs.for_each_position(a, [&](std::uint32_t p) { arcs_at_[p].push_back(a); });
  }

  double bound() {
    const double value = follow();
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
    std::vector<std::uint32_t> fixed;
    double least = kInfinity;
    for (;;) {
      if (next_ == steps_.size()) fault("the tree has no end");
      const ProofStep& step = steps_[next_++];
      if (step.rule == ProofRule::kFix) {
        if (fix(step, fixed)) least = std::min(least, step.threshold);
        continue;
      }
      least = std::min(least, value_of(step));
      for (const std::uint32_t a : fixed) --excluded_[a];
      return least;
    }
  }

  double value_of(const ProofStep& step) {
    if (step.rule == ProofRule::kBound) return price(step.point);
    if (step.rule == ProofRule::kSearch) return search(step);
    if (step.rule == ProofRule::kCliques) return cliques(step);
    return branch(step);
  }

  bool allowed(std::uint32_t a) const { return excluded_[a] == 0; }
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
    for (std::size_t p = 0; p < singletons_.size(); ++p) {
      const double y = multipliers_[p];
      sum.add(p, y);
      if (may_stay_alone(static_cast<std::uint32_t>(p)) && singletons_[p] < y) {
        sum.add(p, singletons_[p]);
        sum.add(p, -y);
      }
    }
    for (std::uint32_t a = 0; a < arcs_.size(); ++a) {
      if (!allowed(a)) continue;
      sum.enlarge(size_[a]);
      terms += static_cast<double>(arcs_.start[a + 1] - arcs_.start[a]) + 3;
      if (!any_arcs || !reduced_[a].negative()) continue;
      sum.add(a, reduced_[a].high());
      sum.add(a, reduced_[a].low());
    }
    return sum.rounded_down(terms + 3 * static_cast<double>(singletons_.size()));
  }

  void start_reduced() {
    reduced_.assign(arcs_.size(), {});
    size_.assign(arcs_.size(), 0.0);
    for (std::uint32_t a = 0; a < arcs_.size(); ++a) {
      if (!allowed(a)) continue;
      reduced_[a].add(arcs_.cost[a]);
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
        const int coefficient = allowed(a) ? coefficient_at(a, position) / cut.divisor : 0;
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
  [[gnu::noinline]] bool fix(const ProofStep& step, std::vector<std::uint32_t>& fixed) {
    const double value = price(step.point);
    const std::size_t before = fixed.size();
    for (std::uint32_t a = 0; a < arcs_.size(); ++a) {
      if (!allowed(a) || reduced_[a].negative()) continue;
      if (with_arc(value, a) >= step.threshold) fixed.push_back(a);
    }
    for (std::size_t i = before; i < fixed.size(); ++i) ++excluded_[fixed[i]];
    return fixed.size() > before;
  }

  double branch(const ProofStep& step) {
    if (step.first >= singletons_.size() || step.second >= singletons_.size() ||
        step.first == step.second)
      fault("branching on indices that are no pair");
    if (++depth_ > kMostProofBranchings) fault("the tree is too deep");
    double least = kInfinity;
    const bool together_first = step.rule == ProofRule::kTogether;
    for (const bool together : {together_first, !together_first}) {
      const std::vector<std::uint32_t> out = excluded_by(step.first, step.second, together);
      for (const std::uint32_t a : out) ++excluded_[a];
      singleton_excluded_[step.first] += together;
      singleton_excluded_[step.second] += together;
      least = std::min(least, follow());
      singleton_excluded_[step.first] -= together;
      singleton_excluded_[step.second] -= together;
      for (const std::uint32_t a : out) --excluded_[a];
    }
    --depth_;
    return least;
  }

  // Arcs that use exactly one of the two indices, or those that use both.
  std::vector<std::uint32_t> excluded_by(std::uint32_t first,
                                         std::uint32_t second,
                                         bool together) const {
    std::vector<std::uint32_t> out;
    for (const std::uint32_t a : arcs_at_[first]) {
      if (arcs_.uses(a, second) != together) out.push_back(a);
    }
    for (const std::uint32_t a : arcs_at_[second]) {
      if (together && !arcs_.uses(a, first)) out.push_back(a);
    }
    return out;
  }

  // The least bound of what a search finds below the threshold, or the threshold.
  [[gnu::noinline]] double search(const ProofStep& step) {
    if (!std::isfinite(step.threshold)) fault("a search without a finite threshold");
    const double value = price(step.point);
    if (value >= step.threshold) return step.threshold;
    const double budget = std::nextafter(step.threshold - value, kInfinity);
    if (!is_searchable(budget)) return value;
    try {
      const double rise =
          least_rise(search_task(step.point, budget), budget, work_, kMostSearchWork);
      return std::min(step.threshold, std::nextafter(value + rise, -kInfinity));
    } catch (const ProofFault& problem) {
      fault(problem.text);
    }
  }

  SearchTask search_task(const ProofPoint& point, double budget) {
    SearchTask task;
    task.num_indices = static_cast<std::uint32_t>(singletons_.size());
    for (std::uint32_t p = 0; p < singletons_.size(); ++p) {
      const double rise = singletons_[p] - multipliers_[p];
      task.rows.push_back({may_stay_alone(p) ? std::max(0.0, below(rise)) : kInfinity, 1});
    }
    std::vector<std::uint32_t> number(arcs_.size(), kNowhere);
    for (std::uint32_t a = 0; a < arcs_.size(); ++a) {
      const double rise = allowed(a) ? std::max(0.0, with_arc(0.0, a)) : kInfinity;
      if (rise >= budget) continue;
      number[a] = static_cast<std::uint32_t>(task.rise.size());
      task.rise.push_back(rise);
      task.entries.emplace_back();
      arcs_.for_each_position(a, [&](std::uint32_t p) { task.entries.back().push_back({p, 1}); });
    }
    for (const ProofCut& cut : point.cuts) add_row(cut, number, task);
    return task;
  }

  void add_row(const ProofCut& cut, const std::vector<std::uint32_t>& number, SearchTask& task) {
    const auto row = static_cast<std::uint32_t>(task.rows.size());
    task.rows.push_back({-cut.multiplier, static_cast<std::uint32_t>(right_side(cut))});
    for_each_coefficient(cut, [&](std::uint32_t a, int coefficient) {
      if (number[a] != kNowhere)
        task.entries[number[a]].push_back({row, static_cast<std::uint32_t>(coefficient)});
    });
  }

  // The same for a search that reckons with arcs alone, whatever the point is.
  [[gnu::noinline]] double cliques(const ProofStep& step) {
    if (!std::isfinite(step.threshold)) fault("a search without a finite threshold");
    const double value = price(step.point, false);
    CliqueTask task;
    for (std::uint32_t a = 0; a < arcs_.size(); ++a) {
      const double gain = allowed(a) ? -with_arc(0.0, a) : 0.0;
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
  const std::vector<double> singletons_;  // by position
  const std::vector<ProofStep>& steps_;
  std::size_t next_ = 0;
  int depth_ = 0;
  std::vector<std::vector<std::uint32_t>> arcs_at_;  // by position
  std::vector<std::uint32_t> excluded_;              // by arc: how often
  std::vector<std::uint32_t> singleton_excluded_;    // by position: how often
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
                  const std::vector<ProofStep>& steps) {
  return PartProof(arcs, singletons, steps).bound();
}

}  // namespace nda::core
