#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <utility>
#include <vector>

#include "nda/io.hpp"
#include "nda/solve.hpp"

// Solves a problem as a tracker does that calls the library again and again.
//
//   warm_benchmark FILE [TIME_LIMIT_S [CALLS]]
//
// prints the seconds that one proof takes on one thread, by the wall's clock or the processor's,
// whichever is less; exit code 1 where there is none in time.  Before it a problem of three arcs is
// solved, which loads what is loaded at the first call only; bench/rivals does the same for those
// that it measures as libraries.  With CALLS a second line has the median of so many calls more.

namespace nda {
namespace {

double processor_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Any two of its arcs share an index, so its relaxation is not integral and it takes a search.
Problem triangle() {
  ProblemBuilder builder({1, 1, 1});
  builder.add_arc({1, 1, 0}, -1);
  builder.add_arc({0, 1, 1}, -1.1);
  builder.add_arc({1, 0, 1}, -1.23456);
  return std::move(builder).build();
}

double seconds_of_call(const Problem& problem, const Options& options, bool& proven) {
  const double before = processor_seconds();
  const Solution solution = solve(problem, options);
  proven = proven && (solution.proven || solution.status == Status::kInfeasible);
  return std::min(processor_seconds() - before, solution.stats.solve_seconds);
}

int run(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: warm_benchmark FILE [TIME_LIMIT_S [CALLS]]\n");
    return 2;
  }
  Options options;
  if (argc > 2) options.time_limit_s = std::atof(argv[2]);
  const int calls = argc > 3 ? std::atoi(argv[3]) : 0;
  const Problem problem = read_problem(argv[1]);
  solve(triangle(), options);
  bool proven = true;
  std::printf("%.9f\n", seconds_of_call(problem, options, proven));
  std::vector<double> seconds;
  for (int call = 0; call < calls; ++call)
    seconds.push_back(seconds_of_call(problem, options, proven));
  std::sort(seconds.begin(), seconds.end());
  if (!seconds.empty()) std::printf("%.9f\n", seconds[seconds.size() / 2]);
  return proven ? 0 : 1;
}

}  // namespace
}  // namespace nda

int main(int argc, char** argv) {
  try {
    return nda::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "warm_benchmark: %s\n", error.what());
    return 2;
  }
}
