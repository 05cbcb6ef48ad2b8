#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "median_time.hpp"
#include "nda/solve.hpp"
#include "sliding_windows.hpp"

// What a hot start saves on a window that moved by one scan.
//
//   hot_starts_benchmark [SCENARIOS] [MOVES] [FIRST_SEED]
//
// solves so many moves of the windows of so many scenarios of every kind, cold and with parts of
// the last window's solution, on one thread, three times each in turn, of which the quickest
// counts. Prints a line for every kind and way, then for every way over the windows of all kinds:
// medians over the windows of the arcs, the share of arcs that the last window had at the same
// cost, microseconds cold and hot, their ratio, evaluations and nodes cold and hot, and the arcs
// that the hot start left open.  Exit code 1 where a hot start changed a cost or was not proven.

namespace nda::bench {
namespace {

constexpr int kRuns = 3;

struct Kind {
  const char* name;
  TrackingOptions options;
};

TrackingOptions window(int scans, int targets, double side, double clutter, int group_size = 0) {
  TrackingOptions options;
  options.scans = scans;
  options.targets = targets;
  options.side = side;
  options.clutter = clutter;
  options.group_size = group_size;
  options.cap = 500;
  return options;
}

std::vector<Kind> kinds() {
  return {{"twice as many false alarms as targets", window(6, 20, 1500, 40)},
          {"little clutter", window(6, 20, 780, 5)},
          {"pairs that fly together", window(6, 20, 1000, 5, 2)},
          {"100 targets", window(5, 100, 2000, 30)},
          {"dense", window(6, 40, 800, 20)},
          {"groups of four", window(6, 20, 1700, 2, 4)}};
}

struct Way {
  const char* name;
  bool multipliers;
  bool arcs;
  double gap;
};

constexpr Way kWays[] = {{"all, proven", true, true, 0},
                         {"multipliers alone, proven", true, false, 0},
                         {"arcs alone, proven", false, true, 0},
                         {"all, to 0.1 %", true, true, 0.001},
                         {"all, to 1 %", true, true, 0.01}};

enum Figure {
  kArcs,
  kSame,
  kCold,
  kHot,
  kRatio,
  kColdEvaluations,
  kHotEvaluations,
  kColdNodes,
  kHotNodes,
  kOpen,
  kNumFigures
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

// The share of the arcs that the last window had, at the same cost.
double share_of_same(const Problem& last, const Problem& window, int kept) {
  std::map<std::vector<Index>, double> costs;
  const auto dimensions = static_cast<std::size_t>(last.num_dimensions());
  for (std::size_t a = 0; a < last.num_arcs(); ++a) {
    WarmStart tuple{{}, {std::vector<Index>(dimensions)}};
    for (std::size_t k = 0; k < dimensions; ++k)
      tuple.arcs[0][k] = last.indices(static_cast<int>(k))[a];
    const bool leaves = tuple.arcs[0][static_cast<std::size_t>(kept)] != 0;
    tuple.shift(1, kept);
    if (!leaves && !tuple.arcs.empty()) costs[tuple.arcs[0]] = last.costs()[a];
  }
  std::size_t same = 0;
  std::vector<Index> tuple(dimensions);
  for (std::size_t a = 0; a < window.num_arcs(); ++a) {
    for (std::size_t k = 0; k < dimensions; ++k) tuple[k] = window.indices(static_cast<int>(k))[a];
    const auto found = costs.find(tuple);
    same += found != costs.end() && found->second == window.costs()[a];
  }
  return static_cast<double>(same) /
         static_cast<double>(std::max<std::size_t>(1, window.num_arcs()));
}

// What a hot start left to the rest of the pipeline.
std::size_t num_open_arcs(const Stats& stats) {
  return stats.arcs_after_shift - stats.exchange.kept - stats.exchange.excluded;
}

class Measurement {
 public:
  // Every window of the sequence but the first.
  void add(const SlidingWindows& sliding) {
    const int kept = sliding.has_tracks ? 1 : 0;
    Solution last = solve(sliding.windows.front());
    for (std::size_t w = 1; w < sliding.windows.size(); ++w) {
      const Problem& problem = sliding.windows[w];
      const double same = share_of_same(sliding.windows[w - 1], problem, kept);
      WarmStart all = warm_start(last);
      all.shift(1, kept);
      for (std::size_t n = 0; n < std::size(kWays); ++n) {
        WarmStart warm = all;
        if (!kWays[n].multipliers) warm.multipliers.clear();
        if (!kWays[n].arcs) warm.arcs.clear();
        compare(problem, warm, kWays[n].gap, same, figures_[n]);
      }
      last = solve(problem);
    }
  }

  // All that the other measured.
  void add(const Measurement& other) {
    for (std::size_t n = 0; n < std::size(kWays); ++n) {
      for (std::size_t f = 0; f < kNumFigures; ++f) {
        const std::vector<double>& more = other.figures_[n][f];
        figures_[n][f].insert(figures_[n][f].end(), more.begin(), more.end());
      }
    }
    is_right_ = is_right_ && other.is_right_;
  }

  void print(const char* kind, bool has_tracks) const {
    for (std::size_t n = 0; n < std::size(kWays); ++n) {
      std::printf("%s\t%s\t%s", has_tracks ? "tracks and scans" : "scans", kind, kWays[n].name);
      for (const std::vector<double>& figure : figures_[n]) std::printf("\t%.4g", median(figure));
      std::printf("\n");
    }
    std::fflush(stdout);
  }

  bool is_right() const { return is_right_; }

 private:
  using Figures = std::vector<double>[kNumFigures];

  void compare(
      const Problem& problem, const WarmStart& warm, double gap, double same, Figures& figures) {
    Options options;
    options.relative_gap = gap;
    Solution cold, hot;
    double cold_us = kInfinity, hot_us = kInfinity;
    for (int run = 0; run < kRuns; ++run) {
      cold_us = std::min(cold_us, microseconds([&] { cold = solve(problem, options); }));
      hot_us = std::min(hot_us, microseconds([&] { hot = solve(problem, options, warm); }));
    }
    const double allowed = gap * std::abs(cold.cost) + 1e-9 * std::abs(cold.cost);
    is_right_ = is_right_ && hot.proven >= (gap == 0) && std::abs(hot.cost - cold.cost) <= allowed;
    const double values[] = {static_cast<double>(problem.num_arcs()),
                             same,
                             cold_us,
                             hot_us,
                             hot_us / cold_us,
                             static_cast<double>(cold.stats.dual_evaluations),
                             static_cast<double>(hot.stats.dual_evaluations),
                             static_cast<double>(cold.stats.nodes),
                             static_cast<double>(hot.stats.nodes),
                             static_cast<double>(num_open_arcs(hot.stats))};
    for (std::size_t f = 0; f < kNumFigures; ++f) figures[f].push_back(values[f]);
  }

  Figures figures_[std::size(kWays)];
  bool is_right_ = true;
};

Measurement measure(const Kind& kind, bool has_tracks, int scenarios, int moves, int first_seed) {
  Measurement measurement;
  TrackingOptions options = kind.options;
  for (int scenario = 0; scenario < scenarios; ++scenario) {
    options.seed = static_cast<std::uint64_t>(first_seed + scenario);
    measurement.add(has_tracks ? track_windows(options, moves) : scan_windows(options, moves));
  }
  measurement.print(kind.name, has_tracks);
  return measurement;
}

bool measure_all(bool has_tracks, int scenarios, int moves, int first_seed) {
  Measurement all;
  for (const Kind& kind : kinds()) all.add(measure(kind, has_tracks, scenarios, moves, first_seed));
  all.print("all of these", has_tracks);
  return all.is_right();
}

}  // namespace
}  // namespace nda::bench

int main(int argc, char** argv) {
  try {
    const int scenarios = argc > 1 ? std::atoi(argv[1]) : 10;
    const int moves = argc > 2 ? std::atoi(argv[2]) : 10;
    const int first_seed = argc > 3 ? std::atoi(argv[3]) : 1;
    bool right = true;
    for (const bool has_tracks : {true, false})
      right = nda::bench::measure_all(has_tracks, scenarios, moves, first_seed) && right;
    return right ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hot_starts_benchmark: %s\n", error.what());
    return 2;
  }
}
