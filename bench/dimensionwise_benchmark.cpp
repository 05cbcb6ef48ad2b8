// What does the dimensionwise move change?
//
//   build/release/bench/dimensionwise_benchmark [--limit S] [--seeds N] FILE...
//
// Prints a table in Markdown, two rows a file: solves of S seconds (default 2) on one thread with
// and without search.dimensionwise, for seeds 1..N (default 3).  The cost after a tenth of the time
// and at the end, the bound, nodes, seconds of the processor; all of them means over the seeds,
// and how many were proven.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "median_time.hpp"
#include "nda/io.hpp"
#include "nda/solve.hpp"

namespace {

struct Means {
  double early_cost = 0;
  double cost = 0;
  double bound = 0;
  double nodes = 0;
  double seconds = 0;
  int proven = 0;
};

Means solve_all(const nda::Problem& problem, bool dimensionwise, double limit_s, int seeds) {
  Means means;
  for (int seed = 1; seed <= seeds; ++seed) {
    nda::Options options;
    options.num_threads = 1;
    options.seed = static_cast<std::uint64_t>(seed);
    options.search.dimensionwise = dimensionwise;
    options.time_limit_s = limit_s / 10;
    means.early_cost += nda::solve(problem, options).cost / seeds;
    options.time_limit_s = limit_s;
    const double begin = now_us(CLOCK_PROCESS_CPUTIME_ID);
    const nda::Solution solution = nda::solve(problem, options);
    means.seconds += 1e-6 * (now_us(CLOCK_PROCESS_CPUTIME_ID) - begin) / seeds;
    means.cost += solution.cost / seeds;
    means.bound += solution.lower_bound / seeds;
    means.nodes += static_cast<double>(solution.stats.nodes) / seeds;
    means.proven += solution.proven ? 1 : 0;
  }
  return means;
}

}  // namespace

int main(int argc, char** argv) {
  double limit_s = 2;
  int seeds = 3;
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--limit" && i + 1 < argc)
      limit_s = std::atof(argv[++i]);
    else if (argument == "--seeds" && i + 1 < argc)
      seeds = std::max(1, std::atoi(argv[++i]));
    else
      files.push_back(argument);
  }
  std::printf("| file | dimensionwise | cost after %g s | cost | bound | nodes | s | proven |\n",
              limit_s / 10);
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (const std::string& file : files) {
    const nda::Problem problem = nda::read_problem(file);
    for (const bool dimensionwise : {false, true}) {
      const Means means = solve_all(problem, dimensionwise, limit_s, seeds);
      std::printf("| %s | %s | %.6g | %.6g | %.6g | %.0f | %.3f | %d of %d |\n",
                  std::filesystem::path(file).filename().string().c_str(),
                  dimensionwise ? "yes" : "no",
                  means.early_cost,
                  means.cost,
                  means.bound,
                  means.nodes,
                  means.seconds,
                  means.proven,
                  seeds);
      std::fflush(stdout);
    }
  }
}
