// Times the ranking of a two-dimensional problem; bench/assign2d_k_best.py writes the problem, runs
// this and compares with Murty's algorithm in its textbook form.
//
//   assign2d_k_best_benchmark FILE SECONDS K...
//
// FILE: see assign2d_instance.hpp.  Prints the microseconds of the best assignment alone (a solver
// that has its memory), then a line for each K: how many assignments there were, the cost of the
// last, the microseconds for listing them from scratch (medians of about SECONDS), and the most
// memory that the process has had so far, in KiB.

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "assign2d_instance.hpp"
#include "median_time.hpp"
#include "nda/assign2d_k_best.hpp"

namespace {

struct Listed {
  std::size_t count = 0;
  double last_cost = 0;
};

// Like a tracker, which looks at each assignment and does not keep it.
Listed list(const Instance& instance, std::size_t k) {
  Listed listed;
  nda::Assign2dRanking ranking(instance.view());
  for (nda::Assign2dResult result; listed.count < k && ranking.next(result); ++listed.count) {
    listed.last_cost = result.cost;
  }
  return listed;
}

double time_of_best(const Instance& instance, double limit_s) {
  const auto solver = nda::make_assign2d_solver(nda::Assign2dMethod::kShortestPath);
  nda::Assign2dResult result;
  return median_time(
      limit_s, [] {}, [&] { solver->solve(instance.view(), result); });
}

// Of this program alone, unlike what getrusage() says.
long peak_memory_kib() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return std::atol(line.c_str() + 6);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: assign2d_k_best_benchmark FILE SECONDS K...\n");
    return 2;
  }
  const Instance instance = read_instance(argv[1]);
  const double limit_s = std::atof(argv[2]);
  std::printf("%.17g\n", time_of_best(instance, limit_s));
  for (int n = 3; n < argc; ++n) {
    const std::size_t k = std::strtoull(argv[n], nullptr, 10);
    Listed listed;
    const double us = median_time(
        limit_s, [] {}, [&] { listed = list(instance, k); });
    std::printf("%zu %.17g %.17g %ld\n", listed.count, listed.last_cost, us, peak_memory_kib());
    std::fflush(stdout);
  }
  return 0;
}
