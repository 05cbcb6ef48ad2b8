#include "relax/lagrangian.hpp"

#include <algorithm>
#include <memory>
#include <numeric>

#include "dual/maximize.hpp"
#include "relax/dual_function.hpp"
#include "relax/separable_dual.hpp"

// The report recovers once, from the optimal multipliers; but its own implementation recovers at
// every nonsmooth step once the problem is three-dimensional, because neighbouring multipliers give
// different alignments and each is a new chance.  `recovery_interval` lies between the two; the
// best multipliers always have their recovery. A packing of cost z recovered on the way ends the
// loop when the bound reaches z: hence the goal moves.

namespace nda::relax {
namespace {

using core::Component;
using core::Packing;

bool keeps_two(const Component& component, const KeptSets& kept) {
  return component.num_dimensions() == 2 || kept.num_kept == 2 ||
         (kept.num_kept > 2 && component.num_dimensions() == 3);
}

// Collects, evaluation by evaluation, the best multipliers and the best packing.
class Loop {
 public:
  Loop(const Component& component, const LagrangianOptions& options, const Recover& recover)
      : component_(component),
        options_(options),
        recover_(recover),
        deadline_(options.deadline.earlier(options.certify_s)),
        pool_(options.alignment_rule, options.num_alignments),
        best_multipliers_(component.num_slots(), 0.0) {
    if (keeps_two(component, options.kept)) {
      function_ = std::make_unique<DualFunction>(component, options.assign2d, deadline_);
    } else {
      auto function = std::make_unique<KeptDual>(component, options.kept);
      kept_ = function.get();
      function_ = std::move(function);
    }
  }

  RelaxedDual& function() { return *function_; }
  const std::vector<double>& best_multipliers() const { return best_multipliers_; }

  LagrangianResult take() {
    result_.alignments = pool_.take();
    if (kept_ != nullptr) {
      result_.kept_evaluations = kept_->evaluations();
      result_.kept_nodes = kept_->nodes();
      if (kept_->num_kept() > 2) result_.kept_bound = best_value_;
    }
    return std::move(result_);
  }

  // Returns false to stop.
  bool observe(const dual::Iterate& iterate) {
    step_s_ = step_.seconds();
    ++result_.evaluations;
    // Only with more kept sets than two may a value be less, or more, than what it proves.
    const double value = function_->num_kept() > 2 ? function_->bound() : iterate.value;
    if (value > best_value_) {
      best_value_ = value;
      function_->multipliers(best_multipliers_);
    }
    const double violation = function_->violation();
    if (pool_.would_lead(iterate.value, violation)) recovered_at_best_ = false;
    pool_.offer(function_->aligned_cells(), iterate.point, iterate.value, violation);
    const int since_first = result_.evaluations - options_.first_recovery;
    if (options_.recovery_interval > 0 && since_first >= 0 &&
        since_first % options_.recovery_interval == 0) {
      recover();
      recovered_at_best_ = recovered_at_best_ || pool_.is_level(iterate.value, violation);
    }
    step_ = {};
    return best_value_ < goal() && has_time();
  }

  void recover_at_best() {
    if (!recover_ || recovered_at_best_ || pool_.best().empty()) return;
    if (result_.recoveries > 0 && best_value_ >= goal()) return;
    if ((result_.recoveries > 0 || !options_.always_recover) && !has_time()) return;
    const std::vector<double>& point = pool_.best().front().point;
    std::vector<double> subgradient(point.size());
    function_->evaluate(point, subgradient);
    recover();
  }

 private:
  double goal() const {
    return std::min(options_.goal, result_.recoveries > 0 ? result_.best.cost : kInfinity);
  }

  // Asked only where there is more to do.
  bool has_time() {
    result_.out_of_time = deadline_.reached() || deadline_.remaining_s() <= step_s_;
    return !result_.out_of_time;
  }

  void recover() {
    if (!recover_) return;
    ++result_.recoveries;
    Packing packing = recover_(point_to_recover());
    if (packing.cost < result_.best.cost) result_.best = std::move(packing);
  }

  // With less than two kept sets there is no alignment: two are kept at the same multipliers.
  const RelaxedDual& point_to_recover() {
    if (function_->num_kept() >= 2) return *function_;
    if (!two_kept_)
      two_kept_ = std::make_unique<DualFunction>(component_, options_.assign2d, deadline_);
    std::vector<double> subgradient(two_kept_->num_variables());
    two_kept_->evaluate(function_->slot_values().subspan(two_kept_->first_slot()), subgradient);
    return *two_kept_;
  }

  const Component& component_;
  const LagrangianOptions& options_;
  const Recover& recover_;
  const core::Deadline deadline_;
  core::Stopwatch step_;  // since the last observation
  double step_s_ = 0;     // what the last evaluation took
  std::unique_ptr<RelaxedDual> function_;
  KeptDual* kept_ = nullptr;                // function_, unless that is a DualFunction
  std::unique_ptr<DualFunction> two_kept_;  // for recoveries, where fewer are kept
  AlignmentPool pool_;
  std::vector<double> best_multipliers_;
  double best_value_ = -kInfinity;
  bool recovered_at_best_ = false;
  LagrangianResult result_;
};

// The same with everything relaxed and coordinate ascent; the kept sets come back for one alignment
// at the end.
LagrangianResult maximize_by_coordinates(const Component& component,
                                         std::span<const double> warm,
                                         const LagrangianOptions& options,
                                         const Recover& recover) {
  const core::Deadline deadline = options.deadline.earlier(options.certify_s);
  SeparableDual function(component);
  std::vector<double> start(warm.begin(), warm.end());
  start.resize(component.num_slots(), 0.0);
  dual::MaximizeOptions limits;
  limits.max_evaluations = options.max_evaluations;
  limits.relative_tolerance = options.relative_tolerance;
  limits.target = options.goal;
  dual::MaximizeResult found = dual::maximize_coordinate(
      function, start, limits, [&](const dual::Iterate&) { return !deadline.reached(); });
  LagrangianResult result;
  result.evaluations = found.evaluations;
  result.u = std::move(found.point);
  if (options.certify) result.lower = make_feasible(component, result.u, options.deadline);
  result.out_of_time = deadline.reached();
  if (result.out_of_time) return result;
  DualFunction kept(component, options.assign2d, deadline);
  AlignmentPool pool(options.alignment_rule, options.num_alignments);
  const std::span<const double> point = std::span(result.u).subspan(kept.first_slot());
  std::vector<double> subgradient(kept.num_variables());
  const double value = kept.evaluate(point, subgradient);
  pool.offer(kept.aligned_cells(), point, value, kept.violation());
  result.alignments = pool.take();
  if (!recover) return result;
  result.best = recover(kept);
  result.recoveries = 1;
  if (result.best.cost >= 0) result.best = {};
  return result;
}

}  // namespace

LagrangianOptions loop_options(const RelaxationOptions& options, const core::Deadline& deadline) {
  LagrangianOptions loop;
  loop.dual_method = options.dual_method;
  loop.assign2d = options.assign2d;
  loop.alignment_rule = options.alignment;
  loop.deadline = deadline;
  return loop;
}

LagrangianResult maximize_dual(const Component& component,
                               std::span<const double> warm,
                               const LagrangianOptions& options,
                               const Recover& recover) {
  if (options.deadline.earlier(options.certify_s).reached()) {
    LagrangianResult nothing;
    nothing.out_of_time = true;
    return nothing;
  }
  const bool two_dimensional = component.num_dimensions() == 2;  // nothing is relaxed
  if (options.dual_method == DualMethod::kCoordinate && !two_dimensional) {
    return maximize_by_coordinates(component, warm, options, recover);
  }
  Loop loop(component, options, recover);
  std::vector<double> start(loop.function().num_variables(), 0.0);
  if (!warm.empty())
    std::copy(warm.begin() + loop.function().first_slot(), warm.end(), start.begin());

  dual::MaximizeOptions limits;
  limits.max_evaluations = options.max_evaluations;
  limits.relative_tolerance = options.relative_tolerance;
  limits.bundle_size = options.bundle_size;
  // Without a merit function values are no bounds.
  if (keeps_two(component, options.kept) || options.kept.merit) limits.target = options.goal;
  // Near the optimum the gap is the right size of a first step; from 0 the method's own guess is
  // better.
  if (!warm.empty() && options.goal < kInfinity) {
    limits.expected_increase =
        std::max(0.0, options.goal - std::accumulate(warm.begin(), warm.end(), 0.0));
  }
  const DualMethod method = two_dimensional ? DualMethod::kBundleTrust : options.dual_method;
  dual::maximize(method, loop.function(), start, limits, [&](const dual::Iterate& iterate) {
    return loop.observe(iterate);
  });
  std::vector<double> u = loop.best_multipliers();
  const double lower = options.certify ? make_feasible(component, u, options.deadline) : -kInfinity;
  if (!options.settle || !options.settle(u, lower)) loop.recover_at_best();
  LagrangianResult result = loop.take();
  result.u = std::move(u);
  result.lower = lower;
  return result;
}

}  // namespace nda::relax
