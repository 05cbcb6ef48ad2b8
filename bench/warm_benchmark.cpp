#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <utility>

#include "nda/io.hpp"
#include "nda/solve.hpp"

// Solves a problem as a tracker does that calls the library again and again.
//
//   warm_benchmark FILE [TIME_LIMIT_S]
//
// prints the seconds that one proof takes on one thread, by the wall's clock or the processor's,
// whichever is less; exit code 1 where there is none in time.  Before it a problem of three arcs is
// solved, which loads what is loaded at the first call only; bench/rivals does the same for those
// that it measures as libraries.

namespace nda {
namespace {

double processor_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Any two of its arcs share an index.
Problem triangle() {
  ProblemBuilder builder({1, 1, 1});
  builder.add_arc({1, 1, 0}, -1);
  builder.add_arc({0, 1, 1}, -1);
  builder.add_arc({1, 0, 1}, -1);
  return std::move(builder).build();
}

int run(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: warm_benchmark FILE [TIME_LIMIT_S]\n");
    return 2;
  }
  Options options;
  if (argc > 2) options.time_limit_s = std::atof(argv[2]);
  const Problem problem = read_problem(argv[1]);
  solve(triangle(), options);
  const double before = processor_seconds();
  const Solution solution = solve(problem, options);
  const double seconds = std::min(processor_seconds() - before, solution.stats.solve_seconds);
  std::printf("%.9f\n", seconds);
  return solution.proven || solution.status == Status::kInfeasible ? 0 : 1;
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
