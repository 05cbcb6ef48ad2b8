#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <string>
#include <vector>

#include "nda/generate.hpp"
#include "nda/k_best.hpp"
#include "nda/solve.hpp"

// What a tracker waits for at every scan: the k best solutions of a window of 20 targets in 6 scans
// with about 5,000 arcs, called again and again on one thread.
//
//   tracker_call_benchmark [WINDOWS] [CALLS]
//
// makes so many windows of every kind, the first seeds with 4,000 to 6,000 arcs, and calls so often
// for each: solve_k_best() for k = 1, 10, 100, and Ranking::next() ten times.  Prints a line for
// every kind and way: milliseconds of processor time, the median of all calls and the worst one.
// The first call of each window is not counted.  Exit code 1 where a rank is not proven.

namespace nda {
namespace {

constexpr std::size_t kLeastArcs = 4000;
constexpr std::size_t kMostArcs = 6000;

struct Kind {
  const char* name;
  TrackingOptions options;
};

TrackingOptions window(double side,
                       double clutter,
                       double detection_probability,
                       int group_size,
                       double group_spread = 20) {
  TrackingOptions options;
  options.scans = 6;
  options.targets = 20;
  options.side = side;
  options.clutter = clutter;
  options.detection_probability = detection_probability;
  options.group_size = group_size;
  options.group_spread = group_spread;
  return options;
}

std::vector<Kind> kinds() {
  return {{"little clutter", window(780, 5, 0.9, 0)},
          {"as many false alarms as targets", window(1080, 20, 0.9, 0)},
          {"twice as many false alarms", window(1500, 40, 0.9, 0)},
          {"one detection in four missed", window(900, 10, 0.75, 0)},
          {"pairs that fly together", window(1000, 5, 0.9, 2)},
          {"groups of four, some way apart", window(1700, 2, 0.9, 4, 60)}};
}

std::vector<Problem> windows_of(const Kind& kind, int count) {
  std::vector<Problem> windows;
  TrackingOptions options = kind.options;
  for (options.seed = 1; static_cast<int>(windows.size()) < count; ++options.seed) {
    Problem problem = generate_tracking(options).problem;
    if (problem.num_arcs() >= kLeastArcs && problem.num_arcs() <= kMostArcs)
      windows.push_back(std::move(problem));
  }
  return windows;
}

double processor_ms() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

struct Times {
  std::vector<double> ms;
  bool proven = true;

  void print(const char* kind, const char* way) {
    std::sort(ms.begin(), ms.end());
    std::printf("%s\t%s\t%.3f\t%.3f\n", kind, way, ms[ms.size() / 2], ms.back());
  }
};

Times time_list(const std::vector<Problem>& windows, std::size_t k, int calls) {
  Times times;
  for (const Problem& problem : windows) {
    for (int call = 0; call <= calls; ++call) {
      const double before = processor_ms();
      const Solution solution = solve_k_best(problem, k);
      if (call > 0) times.ms.push_back(processor_ms() - before);
      times.proven = times.proven && num_proven(solution) == k;
    }
  }
  return times;
}

// All ten together, and in `single` each by itself but the first.
Times time_next(const std::vector<Problem>& windows, int calls, Times& single) {
  Times times;
  for (const Problem& problem : windows) {
    for (int call = 0; call <= calls; ++call) {
      const double begin = processor_ms();
      Ranking ranking(problem);
      RankedSolution next;
      double last = begin;
      for (int rank = 1; rank <= 10; ++rank) {
        times.proven = times.proven && ranking.next(next) && next.proven;
        const double now = processor_ms();
        if (call > 0 && rank > 1) single.ms.push_back(now - last);
        last = now;
      }
      if (call > 0) times.ms.push_back(last - begin);
    }
  }
  return times;
}

bool run(const Kind& kind, int count, int calls) {
  const std::vector<Problem> windows = windows_of(kind, count);
  bool proven = true;
  for (const std::size_t k : {1, 10, 100}) {
    Times times = time_list(windows, k, calls);
    times.print(kind.name, ("k = " + std::to_string(k)).c_str());
    proven = proven && times.proven;
  }
  Times single;
  Times all = time_next(windows, calls, single);
  all.print(kind.name, "next() ten times");
  single.print(kind.name, "each next() after the first");
  return proven && all.proven;
}

}  // namespace
}  // namespace nda

int main(int argc, char** argv) {
  try {
    const int windows = argc > 1 ? std::atoi(argv[1]) : 20;
    const int calls = argc > 2 ? std::atoi(argv[2]) : 10;
    bool proven = true;
    for (const nda::Kind& kind : nda::kinds()) proven = nda::run(kind, windows, calls) && proven;
    return proven ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tracker_call_benchmark: %s\n", error.what());
    return 2;
  }
}
