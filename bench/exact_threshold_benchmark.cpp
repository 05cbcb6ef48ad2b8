// Up to how many arcs is a component enumerated faster than it is relaxed?
//
//   build/release/bench/exact_threshold_benchmark
//
// Components of tracking problems and of random problems, grouped by size; for each group the mean
// time to a proof by enumeration first (BranchOptions::exact_arcs above the size) and by relaxation
// first (exact_arcs = 0), in microseconds. The default of exact_arcs is where the two cross.

#include <cstdio>
#include <map>
#include <vector>

#include "core/component.hpp"
#include "core/shift.hpp"
#include "decompose/components.hpp"
#include "nda/generate.hpp"
#include "nda/solve.hpp"

namespace {

// A problem with one component of its own.
nda::Problem isolate(const nda::core::Component& component) {
  nda::ProblemBuilder builder(component.sizes);
  std::vector<nda::Index> tuple(component.sizes.size());
  for (nda::core::ArcId a = 0; a < component.num_arcs(); ++a) {
    for (std::size_t k = 0; k < tuple.size(); ++k) tuple[k] = component.indices[k][a];
    builder.add_arc(tuple, component.costs[a]);
  }
  return std::move(builder).build();
}

// Problems by the power of two below their number of arcs.
using Groups = std::map<std::size_t, std::vector<nda::Problem>>;

constexpr std::size_t kLargest = 256;
constexpr std::size_t kPerGroup = 40;

void add_components(const nda::Problem& problem, Groups& groups) {
  const nda::core::Shift shift = nda::core::make_shift(problem);
  const auto partition = nda::decompose::partition(problem, shift);
  nda::core::Cutter cutter;
  for (std::size_t c = 0; c < partition.num_components(); ++c) {
    std::size_t group = 1;
    while (2 * group <= partition.component(c).size()) group *= 2;
    if (group > kLargest || groups[group].size() >= kPerGroup) continue;
    const auto component = cutter.cut(problem, shift, partition.component(c));
    if (component.num_dimensions() > 2) groups[group].push_back(isolate(component));
  }
}

Groups collect() {
  Groups groups;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    nda::TrackingOptions tracking;
    tracking.scans = 5;
    tracking.targets = 400;
    tracking.side = 5000;
    tracking.clutter = 200;
    tracking.seed = seed;
    add_components(nda::generate_tracking(tracking).problem, groups);
    for (std::size_t arcs = 8; arcs <= 1500; arcs = arcs * 3 / 2) {
      nda::PooreSparseOptions random;
      random.min_size = random.max_size = static_cast<nda::Index>(3 + arcs / 60);
      random.arcs = arcs;
      random.seed = seed;
      add_components(nda::generate_poore_sparse(random).problem, groups);
    }
  }
  return groups;
}

double mean_microseconds(const std::vector<nda::Problem>& problems, std::size_t exact_arcs) {
  nda::Options options;
  options.branch.exact_arcs = exact_arcs;
  double seconds = 0;
  for (const nda::Problem& problem : problems)
    seconds += nda::solve(problem, options).stats.solve_seconds;
  return 1e6 * seconds / static_cast<double>(problems.size());
}

}  // namespace

int main() {
  std::printf(
      "| arcs | components | enumeration first, us | relaxation first, us |\n|---|---|---|---|\n");
  for (const auto& [group, problems] : collect()) {
    std::printf("| %zu .. %zu | %zu | %.1f | %.1f |\n",
                group,
                2 * group - 1,
                problems.size(),
                mean_microseconds(problems, 4 * kLargest),
                mean_microseconds(problems, 0));
    std::fflush(stdout);
  }
}
