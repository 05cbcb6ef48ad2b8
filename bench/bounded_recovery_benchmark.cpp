#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bounded/bound.hpp"
#include "bounded/branch_and_bound.hpp"
#include "bounded/descent.hpp"
#include "bounded/dual_function.hpp"
#include "bounded/lagrangian.hpp"
#include "bounded/recursive.hpp"
#include "bounded/separable_dual.hpp"
#include "bounded/split.hpp"
#include "core/clock.hpp"
#include "dual/maximize.hpp"
#include "nda/generate.hpp"
#include "support/merged_tracks.hpp"

// What feasible solutions of problems with bounds cost: greedy choices improved by exchanges,
// recursive recovery (3.7)-(3.9), and the better of greedy and recovered ones, both improved by
// exchanges; each at the multipliers of ten sweeps of coordinate ascent and at those of fifty
// evaluations of bundle trust.
//
//   bounded_recovery_benchmark
//
// prints a line of a table in Markdown for each family and multipliers: how much more than the
// optimum all parts cost together, in percent of it, and the milliseconds of processor time.  What
// branch and bound does not prove in 20 seconds is left out.

namespace nda::bounded {
namespace {

using core::ArcId;

constexpr int kSeeds = 10;
constexpr std::size_t kArcsPerIndex = 12;

struct Family {
  std::string name;
  std::function<Problem(std::uint64_t seed)> make;
};

Family merged_tracks(const char* name, int tracks, double spacing, int scans) {
  return {name, [=](std::uint64_t seed) {
            support::MergedTracksOptions options;
            options.tracks = tracks;
            options.spacing = spacing;
            options.scans = scans;
            options.seed = seed;
            return support::MergedTracks(options).make();
          }};
}

Family merged(const char* name, int scans, int targets, double side) {
  return {name, [=](std::uint64_t seed) {
            MergedOptions options;
            options.scans = scans;
            options.targets = targets;
            options.side = side;
            options.seed = seed;
            return generate_merged(options).problem;
          }};
}

Family bounded(const char* name, int dimensions, Index size, std::size_t arcs) {
  return {name, [=](std::uint64_t seed) {
            BoundedOptions options;
            options.dimensions = dimensions;
            options.size = size;
            options.arcs = arcs;
            options.seed = seed;
            return generate_bounded(options).problem;
          }};
}

std::vector<Family> families() {
  return {merged_tracks("tracks, three scans", 100, 3, 3),
          merged_tracks("tracks, many merge", 60, 2.5, 3),
          merged_tracks("tracks, five scans", 40, 3.5, 5),
          merged("merged, two scans", 2, 24, 150),
          merged("merged, three scans", 3, 12, 120),
          bounded("random, N = 3", 3, 30, 600),
          bounded("random, N = 4", 4, 20, 600),
          bounded("random, N = 6", 6, 12, 600)};
}

constexpr int kWays = 3;

struct Sums {
  double optimum = 0;
  double cost[kWays] = {};
  double seconds[kWays] = {};
  int parts = 0;
};

// What is preferred, then the arcs of low reduced cost.
Choice exchange(const BoundedComponent& part,
                std::span<const double> u,
                std::span<const ArcId> preferred) {
  std::vector<std::pair<double, ArcId>> order;
  for (ArcId a = 0; a < part.num_arcs(); ++a)
    order.emplace_back(core::reduced_cost(part.graph, u, a), a);
  const std::size_t count = std::min(order.size(), kArcsPerIndex * part.rows.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end());
  std::vector<ArcId> arcs(preferred.begin(), preferred.end());
  for (std::size_t n = 0; n < count; ++n) {
    if (!std::binary_search(preferred.begin(), preferred.end(), order[n].second))
      arcs.push_back(order[n].second);
  }
  return greedy_descent(part, arcs, {});
}

void measure(const BoundedComponent& part, std::vector<double> u, double optimum, Sums& sums) {
  DualFunction point(part);
  std::vector<double> subgradient(point.num_variables());
  point.evaluate(std::span(u).subspan(point.first_slot()), subgradient);
  point.multipliers(u);
  clamp(part, u);
  sums.optimum += optimum;
  ++sums.parts;
  const auto take = [&](int way, auto&& make) {
    const std::clock_t start = std::clock();
    sums.cost[way] += make().cost;
    sums.seconds[way] += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  take(0, [&] { return exchange(part, u, point.chosen_arcs()); });
  take(1, [&] { return recover_recursively(part, point, {}, {}); });
  take(2, [&] {
    const Choice recovered = exchange(part, u, recover_recursively(part, point, {}, {}).arcs);
    const Choice greedy = exchange(part, u, point.chosen_arcs());
    return greedy.cost < recovered.cost ? greedy : recovered;
  });
}

void measure(const BoundedComponent& part, Sums& ascent, Sums& bundle) {
  const std::vector<double> zero(part.rows.size(), 0.0);
  SeparableDual separable(part);
  dual::MaximizeOptions sweeps;
  sweeps.max_evaluations = 10;
  const std::vector<double> ascended = dual::maximize_coordinate(separable, zero, sweeps).point;
  LagrangianOptions loop;
  loop.max_evaluations = 50;
  const std::vector<double> maximal = maximize_dual(part, ascended, loop, {}).u;
  const SearchLimits limits{1e-7, 0, 1000000, core::Deadline(20)};
  const SearchResult best = branch_and_bound(part, make_choice(part, {}), maximal, limits, {});
  if (best.end != SearchEnd::kComplete) return;
  measure(part, ascended, best.best.cost, ascent);
  measure(part, maximal, best.best.cost, bundle);
}

void print(const std::string& family, const char* multipliers, const Sums& sums) {
  std::printf("| %s | %d | %s |", family.c_str(), sums.parts, multipliers);
  for (const double cost : sums.cost)
    std::printf(" %.2f |", 100 * (cost - sums.optimum) / std::abs(sums.optimum));
  for (const double seconds : sums.seconds) std::printf(" %.1f |", 1e3 * seconds);
  std::printf("\n");
  std::fflush(stdout);
}

void run(const Family& family) {
  Sums ascent;
  Sums bundle;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    for (const BoundedComponent& part : split(family.make(seed), {}).parts) {
      if (part.graph.num_dimensions() > 2) measure(part, ascent, bundle);
    }
  }
  print(family.name, "ascent", ascent);
  print(family.name, "bundle", bundle);
}

}  // namespace
}  // namespace nda::bounded

int main() try {
  std::printf("| family | parts | multipliers | exchanges, %% | recovery, %% | both, %% ");
  std::printf(
      "| exchanges, ms | recovery, ms | both, ms |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const nda::bounded::Family& family : nda::bounded::families()) nda::bounded::run(family);
  return 0;
} catch (const std::exception& fault) {
  std::fprintf(stderr, "%s\n", fault.what());
  return 1;
}
