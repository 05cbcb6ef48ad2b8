// Which way to maximise the dual is best for a fixed number of evaluations?
//
//   build/release/bench/dual_methods_benchmark [INSTANCES]
//
// The report (section 4.3) says that bundle trust is, for a small fixed number of nonsmooth steps.
// On tracking instances of three kinds each method starts at 0 and is stopped after 10, 20, 50 and
// 200 evaluations; the table shows how far its bound is below the best bound known, in per cent of
// that, as median and range over the instances, and on how many of them it is the best of the
// methods.  A last row and a sentence say what that means for the report's claim: it is confirmed
// where bundle trust has the lowest median and is the best on more than half of the instances,
// refuted where another method has a lower median.

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

// Bounds nearer than that are equally good, in per cent.
constexpr double kTie = 1e-6;

// [contender][instance]: per cent below the best bound known.
using Gaps = std::vector<std::vector<double>>;

Gaps measure(const std::vector<Component>& components,
             const std::vector<double>& best,
             int evaluations) {
  Gaps gaps;
  for (const Contender& contender : kContenders) {
    auto& row = gaps.emplace_back();
    for (std::size_t i = 0; i < components.size(); ++i) {
      const double value = bound(components[i], contender.method, evaluations);
      row.push_back(100 * (best[i] - value) / std::abs(best[i]));
    }
  }
  return gaps;
}

// On how many instances no other contender is better.
std::size_t count_best(const Gaps& gaps, std::size_t contender) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < gaps[contender].size(); ++i) {
    count += std::all_of(gaps.begin(), gaps.end(), [&](const std::vector<double>& other) {
      return gaps[contender][i] <= other[i] + kTie;
    });
  }
  return count;
}

// Bundle trust is contender 0.
const char* verdict(const Gaps& gaps) {
  for (std::size_t other = 1; other < gaps.size(); ++other) {
    if (median(gaps[other]) < median(gaps[0])) return "refuted";
  }
  return 2 * count_best(gaps, 0) > gaps[0].size() ? "confirmed" : "undecided";
}

void print_table(const std::vector<Gaps>& columns) {
  std::printf("| method | 10 | 20 | 50 | 200 evaluations |\n|---|---|---|---|---|\n");
  for (std::size_t c = 0; c < std::size(kContenders); ++c) {
    std::printf("| %s |", kContenders[c].name);
    for (const Gaps& gaps : columns) {
      const auto [least, most] = std::minmax_element(gaps[c].begin(), gaps[c].end());
      std::printf(" %.3f %% (%.3f .. %.3f), best on %zu |",
                  median(gaps[c]),
                  *least,
                  *most,
                  count_best(gaps, c));
    }
    std::printf("\n");
  }
  std::printf("| bundle trust is best |");
  for (const Gaps& gaps : columns) std::printf(" %s |", verdict(gaps));
  std::printf("\n");
}

void print_sentence(const std::vector<Gaps>& columns) {
  std::printf("\nThat bundle trust is best for a fixed number of evaluations is");
  for (std::size_t e = 0; e < columns.size(); ++e) {
    const Gaps& gaps = columns[e];
    std::printf("%s %s at %d (best on %zu of %zu instances",
                e == 0 ? "" : ",",
                verdict(gaps),
                kEvaluations[e],
                count_best(gaps, 0),
                gaps[0].size());
    for (std::size_t c = 1; c < gaps.size(); ++c) {
      std::printf(", %s on %zu", kContenders[c].name, count_best(gaps, c));
    }
    std::printf(")");
  }
  std::printf(".\n");
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
  std::vector<Gaps> columns;
  for (const int evaluations : kEvaluations) {
    columns.push_back(measure(components, best, evaluations));
  }
  print_table(columns);
  print_sentence(columns);
}
