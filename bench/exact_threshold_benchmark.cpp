// Up to how many arcs is a component enumerated faster than it is relaxed?
//
//   build/release/bench/exact_threshold_benchmark
//
// Components of tracking problems and of random problems, grouped by size; for each group the time
// to a proof by enumeration first (BranchOptions::exact_arcs above the size) and by what the
// pipeline does otherwise (exact_arcs = 0: relaxation, search, branch and cut).  A time is the
// least of several runs, of the processor, in microseconds.  Sentences below the table say where
// the medians cross (a few hard components make the means), whether that is the default of
// exact_arcs, and how far apart they are below it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <numeric>
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

// Problems by the size that opens their group.
using Groups = std::map<std::size_t, std::vector<nda::Problem>>;

constexpr std::size_t kLargest = 362;
constexpr std::size_t kPerGroup = 40;
constexpr int kRuns = 3;

// Groups open at the powers of two, from 32 on at those of its square root.
std::size_t opening(std::size_t arcs) {
  std::size_t power = 1;
  while (2 * power <= arcs) power *= 2;
  const auto middle = static_cast<std::size_t>(std::ceil(static_cast<double>(power) * M_SQRT2));
  return power >= 32 && arcs >= middle ? middle : power;
}

void add_components(const nda::Problem& problem, Groups& groups) {
  const nda::core::Shift shift = nda::core::make_shift(problem);
  const auto partition = nda::decompose::partition(problem, shift);
  nda::core::Cutter cutter;
  for (std::size_t c = 0; c < partition.num_components(); ++c) {
    const std::size_t arcs = partition.component(c).size();
    if (arcs > kLargest || groups[opening(arcs)].size() >= kPerGroup) continue;
    const auto component = cutter.cut(problem, shift, partition.component(c));
    if (component.num_dimensions() > 2) groups[opening(arcs)].push_back(isolate(component));
  }
}

Groups collect() {
  Groups groups;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    nda::TrackingOptions tracking;
    tracking.scans = 5;
    tracking.targets = 400;
    tracking.side = 5000;
    tracking.clutter = 200;
    tracking.seed = seed;
    add_components(nda::generate_tracking(tracking).problem, groups);
    for (std::size_t arcs = 8; arcs <= 1500; arcs = arcs * 4 / 3) {
      nda::PooreSparseOptions random;
      random.min_size = random.max_size = static_cast<nda::Index>(3 + arcs / 60);
      random.arcs = arcs;
      random.seed = seed;
      add_components(nda::generate_poore_sparse(random).problem, groups);
    }
  }
  return groups;
}

// Microseconds to a proof.
double time_us(const nda::Problem& problem, std::size_t exact_arcs) {
  nda::Options options;
  options.method = nda::Method::kAuto;
  options.branch.exact_arcs = exact_arcs;
  double least = nda::kInfinity;
  for (int run = 0; run < kRuns; ++run) {
    const std::clock_t begin = std::clock();
    nda::solve(problem, options);
    least = std::min(least, 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return least;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median(std::vector<double> values) {
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), half, values.end());
  return *half;
}

struct Row {
  std::size_t first = 0;
  std::size_t last = 0;
  std::size_t components = 0;
  std::size_t wins = 0;        // of enumeration first
  std::array<double, 2> mean;  // enumeration first, relaxation first
  std::array<double, 2> median;
};

Row measure(std::size_t first, std::size_t last, const std::vector<nda::Problem>& problems) {
  std::array<std::vector<double>, 2> times;
  Row row{first, last, problems.size(), 0, {}, {}};
  for (const nda::Problem& problem : problems) {
    times[0].push_back(time_us(problem, kLargest));
    times[1].push_back(time_us(problem, 0));
    if (times[0].back() < times[1].back()) ++row.wins;
  }
  for (std::size_t order = 0; order < 2; ++order) {
    row.mean[order] = mean(times[order]);
    row.median[order] = median(times[order]);
  }
  return row;
}

void print(const Row& row) {
  std::printf("| %zu .. %zu | %zu | %.0f | %.0f | %.0f | %.0f | %zu |\n",
              row.first,
              row.last,
              row.components,
              row.median[0],
              row.median[1],
              row.mean[0],
              row.mean[1],
              row.wins);
  std::fflush(stdout);
}

using Figures = std::array<double, 2> Row::*;

// The rows before the first in which enumeration first is not the faster one.
std::size_t rows_won(const std::vector<Row>& rows, Figures figures) {
  const auto lost = std::find_if(rows.begin(), rows.end(), [&](const Row& row) {
    return (row.*figures)[0] >= (row.*figures)[1];
  });
  return static_cast<std::size_t>(lost - rows.begin());
}

std::size_t last_won(const std::vector<Row>& rows, Figures figures) {
  const std::size_t won = rows_won(rows, figures);
  return won == 0 ? 0 : rows[won - 1].last;
}

// The largest difference of the medians among components that the default enumerates first.
double largest_difference(const std::vector<Row>& rows, std::size_t preset) {
  double largest = 0;
  for (const Row& row : rows) {
    if (row.last > preset) break;
    largest = std::max(largest, std::abs(row.median[0] - row.median[1]));
  }
  return largest;
}

// The default is supported if it lies in the last row won or opens the first one lost.
void print_sentence(const std::vector<Row>& rows) {
  const std::size_t threshold = last_won(rows, &Row::median);
  const std::size_t won = rows_won(rows, &Row::median);
  const std::size_t preset = nda::BranchOptions{}.exact_arcs;
  const bool supported = won > 0 && preset >= rows[won - 1].first && preset <= threshold + 1;
  std::printf(
      "\nThe median of enumeration first is the lower one up to %zu arcs, which is the threshold"
      " that the table supports; the default of `branch.exact_arcs`, %zu, is %s.  The mean, which a"
      " few hard components make, is the lower one up to %zu arcs.  Below the default the medians "
      "are at"
      " most %.0f us apart.\n",
      threshold,
      preset,
      supported ? "confirmed" : "refuted",
      last_won(rows, &Row::mean),
      largest_difference(rows, preset));
}

}  // namespace

int main() {
  std::printf(
      "| arcs | components | enumeration first, us: median | relaxation first: median |"
      " enumeration first: mean | relaxation first: mean | enumeration first is faster on |\n"
      "|---|---|---|---|---|---|---|\n");
  const Groups groups = collect();
  std::vector<Row> rows;
  for (auto group = groups.begin(); group != groups.end(); ++group) {
    const auto next = std::next(group);
    const std::size_t last = next == groups.end() ? kLargest : next->first - 1;
    rows.push_back(measure(group->first, last, group->second));
    print(rows.back());
  }
  print_sentence(rows);
}
