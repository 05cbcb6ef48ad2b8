#include "bounded/lagrangian.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "bounded/bound.hpp"
#include "bounded/dual_function.hpp"
#include "dual/maximize.hpp"

// The loop of the ordinary pipeline (relax/lagrangian.hpp), with flows in place of assignments.
// Multipliers need no feasibility pass: whatever they are, they prove something.

namespace nda::bounded {
namespace {

int kept_of(const BoundedComponent& component, int asked) {
  const int dimensions = component.graph.num_dimensions();
  return dimensions <= 2 ? dimensions : std::min(asked, dimensions - 1);
}

class Loop {
 public:
  Loop(const BoundedComponent& component,
       const LagrangianOptions& options,
       const Recover& recover,
       const std::function<bool(const LagrangianResult&)>& observe)
      : component_(component),
        options_(options),
        recover_(recover),
        observe_(observe),
        u_(component.rows.size(), 0.0) {
    const int num_kept = kept_of(component, options.num_kept);
    if (num_kept > 2) {
      auto function = std::make_unique<KeptDual>(component, num_kept, options.solve, options.merit);
      kept_ = function.get();
      function_ = std::move(function);
    } else {
      function_ = std::make_unique<DualFunction>(component, num_kept);
    }
    result_.best = make_choice(component, {});
    result_.u = u_;
  }

  RelaxedDual& function() { return *function_; }

  // Returns false to stop.
  bool observe(const dual::Iterate& iterate) {
    ++result_.evaluations;
    if (kept_ != nullptr) result_.nodes = kept_->answer().nodes;
    learn(kept_ != nullptr ? function_->bound() : iterate.value);
    if (iterate.value >= iterate.best_value) is_recovered_at_best_ = false;
    const std::int64_t since_first = result_.evaluations - 1;
    if (options_.recovery_interval > 0 && since_first % options_.recovery_interval == 0) {
      recover();
      if (iterate.value >= iterate.best_value) is_recovered_at_best_ = true;
    }
    if (observe_ && !observe_(result_)) return false;
    return !is_closed() && !options_.deadline.reached();
  }

  // At the best point.
  LagrangianResult finish(std::span<const double> point) {
    const bool out_of_time = result_.recoveries > 0 && options_.deadline.reached();
    if (!is_recovered_at_best_ && !is_closed() && !out_of_time) {
      std::vector<double> subgradient(point.size());
      function_->evaluate(point, subgradient);
      recover();
    }
    return std::move(result_);
  }

 private:
  bool is_closed() const {
    return std::max(result_.lower, result_.kept_bound) >= result_.best.cost - options_.margin;
  }

  void learn(double value) {
    if (kept_ != nullptr) result_.kept_bound = std::max(result_.kept_bound, value);
    if (value <= best_value_ && best_value_ > -kInfinity) return;
    best_value_ = value;
    function_->multipliers(u_);
    clamp(component_, u_);
    const double lower = options_.certify ? lagrangian_bound(component_, u_) : -kInfinity;
    if (lower < result_.lower) return;
    result_.lower = lower;
    result_.u = u_;
  }

  void recover() {
    if (!recover_) return;
    ++result_.recoveries;
    Choice choice = recover_(point_to_recover());
    if (choice.cost < result_.best.cost) result_.best = std::move(choice);
  }

  // With less than two kept dimensions there is no alignment: two are kept at the same multipliers.
  const RelaxedDual& point_to_recover() {
    if (function_->num_kept() >= std::min(2, component_.graph.num_dimensions())) return *function_;
    if (!two_kept_) two_kept_ = std::make_unique<DualFunction>(component_);
    std::vector<double> subgradient(two_kept_->num_variables());
    two_kept_->evaluate(function_->slot_values().subspan(two_kept_->first_slot()), subgradient);
    return *two_kept_;
  }

  const BoundedComponent& component_;
  const LagrangianOptions& options_;
  const Recover& recover_;
  const std::function<bool(const LagrangianResult&)>& observe_;
  std::unique_ptr<RelaxedDual> function_;
  const KeptDual* kept_ = nullptr;          // function_, where it keeps three or more
  std::unique_ptr<DualFunction> two_kept_;  // for recoveries, where fewer are kept
  std::vector<double> u_;
  double best_value_ = -kInfinity;
  bool is_recovered_at_best_ = false;
  LagrangianResult result_;
};

}  // namespace

LagrangianResult maximize_dual(const BoundedComponent& component,
                               std::span<const double> warm,
                               const LagrangianOptions& options,
                               const Recover& recover,
                               const std::function<bool(const LagrangianResult&)>& observe) {
  Loop loop(component, options, recover, observe);
  dual::MaximizeOptions limits;
  limits.max_evaluations = options.max_evaluations;
  limits.relative_tolerance = options.relative_tolerance;
  const std::span<const double> start = warm.subspan(loop.function().first_slot());
  const DualMethod method = options.dual_method == DualMethod::kCoordinate
                                ? DualMethod::kBundleTrust
                                : options.dual_method;
  const dual::MaximizeResult found =
      dual::maximize(method, loop.function(), start, limits, [&](const dual::Iterate& iterate) {
        return loop.observe(iterate);
      });
  return loop.finish(found.point);
}

}  // namespace nda::bounded
