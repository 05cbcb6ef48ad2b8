// Which way to maximise the dual is best for a fixed number of evaluations?
//
//   build/release/bench/dual_methods [INSTANCES]
//
// The report (section 4.3) says that bundle trust is, for a small fixed number of nonsmooth steps.
// On tracking instances of three kinds each method starts at 0 and is stopped after 10, 20, 50 and
// 200 evaluations; the table shows how far its bound is below the best bound known, in per cent of
// that, as the median over the instances.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/component.hpp"
#include "core/shift.hpp"
#include "decompose/components.hpp"
#include "nda/generate.hpp"
#include "relax/lagrangian.hpp"

namespace {

using nda::DualMethod;
using nda::core::Component;

constexpr int kEvaluations[] = {10, 20, 50, 200};

struct Contender {
  const char* name;
  DualMethod method;
};

constexpr Contender kContenders[] = {{"bundle trust", DualMethod::kBundleTrust},
                                     {"subgradient", DualMethod::kSubgradient},
                                     {"volume", DualMethod::kVolume}};

nda::TrackingOptions instance_options(int number) {
  nda::TrackingOptions options;
  options.seed = static_cast<std::uint64_t>(number);
  switch (number % 3) {
    case 0:  // one component, dense clutter
      options.scans = 6;
      options.targets = 100;
      options.side = 1000;
      options.clutter = 30;
      options.cap = 500;
      break;
    case 1:  // groups that cross
      options.scans = 7;
      options.targets = 30;
      options.side = 1500;
      options.group_size = 6;
      options.cap = 500;
      break;
    default:  // wide and sparse
      options.scans = 5;
      options.targets = 400;
      options.side = 3000;
      options.clutter = 100;
      options.cap = 300;
  }
  return options;
}

Component largest_component(const nda::Problem& problem) {
  const nda::core::Shift shift = nda::core::make_shift(problem);
  const auto partition = nda::decompose::partition(problem, shift);
  std::size_t largest = 0;
  for (std::size_t c = 1; c < partition.num_components(); ++c) {
    if (partition.component(c).size() > partition.component(largest).size()) largest = c;
  }
  nda::core::Cutter cutter;
  return cutter.cut(problem, shift, partition.component(largest));
}

double bound(const Component& component, DualMethod method, int evaluations) {
  nda::relax::LagrangianOptions options;
  options.dual_method = method;
  options.max_evaluations = evaluations;
  options.recovery_interval = 0;
  return nda::relax::maximize_dual(component, {}, options, {}).lower;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

}  // namespace

int main(int argc, char** argv) {
  const int num_instances = argc > 1 ? std::atoi(argv[1]) : 20;
  std::vector<Component> components;
  std::vector<double> best;
  for (int number = 1; number <= num_instances; ++number) {
    components.push_back(
        largest_component(nda::generate_tracking(instance_options(number)).problem));
    const Component& component = components.back();
    best.push_back(std::max(bound(component, DualMethod::kVolume, 3000),
                            bound(component, DualMethod::kBundleTrust, 1000)));
    std::fprintf(stderr,
                 "instance %2d: %zu arcs, %zu indices, best bound %.6f\n",
                 number,
                 component.num_arcs(),
                 component.num_indices(),
                 best.back());
  }
  std::printf("| method | 10 | 20 | 50 | 200 evaluations |\n|---|---|---|---|---|\n");
  for (const Contender& contender : kContenders) {
    std::printf("| %s |", contender.name);
    for (const int evaluations : kEvaluations) {
      std::vector<double> gaps;
      for (std::size_t i = 0; i < components.size(); ++i) {
        const double value = bound(components[i], contender.method, evaluations);
        gaps.push_back(100 * (best[i] - value) / std::abs(best[i]));
      }
      std::printf(" %.3f %% (%.3f .. %.3f) |",
                  median(gaps),
                  *std::min_element(gaps.begin(), gaps.end()),
                  *std::max_element(gaps.begin(), gaps.end()));
    }
    std::printf("\n");
  }
}
