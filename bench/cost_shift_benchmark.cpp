// What does the cost shift (report, 4.8) do for the convergence of the dual?
//
//   build/release/bench/cost_shift_benchmark FILE...
//
// One row a file, whose components it takes as one.  Bundle trust begins at 0 with two kept sets,
// with the costs as they are, with singletons shifted to zero, and with the most negative cost
// shifted to zero on top of that (relax::make_feasible).  Invariance makes these the same function,
// moved and raised by a constant (docs/relaxations.md), so the first is evaluated by way of the
// second; what differs is where 0 is and how large values are.  Prints the per cent of the gap
// between the first shifted value and the best value known that is left after 10, 20, 50 and 200
// evaluations; more than 100 where it is below that first value still.

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "core/component.hpp"
#include "core/shift.hpp"
#include "dual/maximize.hpp"
#include "nda/io.hpp"
#include "relax/dual_function.hpp"

namespace {

using nda::core::Component;

constexpr int kEvaluations[] = {10, 20, 50, 200};
constexpr int kReferenceEvaluations = 2000;

// q at u - shift, plus a constant.
class Moved : public nda::dual::ConcaveFunction {
 public:
  Moved(nda::relax::DualFunction& function, std::vector<double> shift, double constant)
      : function_(function), shift_(std::move(shift)), constant_(constant) {}

  std::size_t num_variables() const override { return shift_.size(); }
  double evaluate(std::span<const double> u, std::span<double> subgradient) override {
    std::vector<double> moved(u.begin(), u.end());
    for (std::size_t j = 0; j < moved.size(); ++j) moved[j] -= shift_[j];
    return constant_ + function_.evaluate(moved, subgradient);
  }

 private:
  nda::relax::DualFunction& function_;
  const std::vector<double> shift_;
  const double constant_;
};

// Best value, without the constant, after each number of evaluations.
std::vector<double> best_values(const Component& component,
                                std::span<const double> shift_by_slot,
                                double constant,
                                int max_evaluations) {
  nda::relax::DualFunction function(component);
  const std::span<const double> relaxed = shift_by_slot.subspan(function.first_slot());
  Moved moved(function, {relaxed.begin(), relaxed.end()}, constant);
  nda::dual::MaximizeOptions options;
  options.max_evaluations = max_evaluations;
  std::vector<double> values;
  const std::vector<double> zero(moved.num_variables(), 0.0);
  nda::dual::maximize_bundle_trust(moved, zero, options, [&](const nda::dual::Iterate& iterate) {
    values.push_back(iterate.best_value - constant);
    return true;
  });
  return values;
}

void print_row(const std::string& file) {
  const nda::Problem problem = nda::read_problem(file);
  const nda::core::Shift shift = nda::core::make_shift(problem);
  const Component component = nda::core::whole_problem(problem, shift);
  const std::vector<double> zero(component.num_slots(), 0.0);
  std::vector<double> singletons(component.num_slots(), 0.0);
  for (std::size_t k = 0; k < shift.base.size(); ++k)
    std::copy(shift.base[k].begin(), shift.base[k].end(), singletons.begin() + component.offset[k]);
  std::vector<double> most_negative = zero;
  const double first_bound = nda::relax::make_feasible(component, most_negative);
  for (double& multiplier : most_negative) multiplier = -multiplier;
  const std::vector<double> reference = best_values(component, zero, 0, kReferenceEvaluations);
  const double gap = reference.back() - reference.front();
  const std::vector<std::vector<double>> runs = {
      best_values(component, singletons, shift.constant, kEvaluations[3]),
      best_values(component, zero, 0, kEvaluations[3]),
      best_values(component, most_negative, -first_bound, kEvaluations[3])};
  const std::string name = file.substr(file.find_last_of('/') + 1);
  std::printf("| %s |", name.substr(0, name.find(".nda")).c_str());
  for (const std::vector<double>& values : runs) {
    for (const int evaluations : kEvaluations) {
      const std::size_t at = std::min<std::size_t>(values.size(), evaluations) - 1;
      std::printf(" %.3g |", 100 * std::max(0.0, reference.back() - values[at]) / gap);
    }
  }
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  std::printf(
      "| file | as they are: 10 | 20 | 50 | 200 | singletons to zero: 10 | 20 | 50 | 200 |"
      " most negative to zero: 10 | 20 | 50 | 200 |\n");
  std::printf("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (int n = 1; n < argc; ++n) print_row(argv[n]);
}
