// Times a two-dimensional solver on one problem; bench/assign2d.py writes the problem, runs this
// and compares with scipy.
//
//   assign2d_benchmark FILE METHOD [SECONDS]
//
// FILE: see assign2d_instance.hpp.  METHOD: shortest-path, auction or network-simplex.  Prints
// cost, then microseconds cold, warm with few changes, warm with small changes everywhere
// (medians), each as soon as it is known.  A figure gets about SECONDS (default 0.3), and at least
// one run.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "assign2d_instance.hpp"
#include "median_time.hpp"
#include "nda/assign2d.hpp"

namespace {

// Moves the costs of a share of the rows by up to step times the range of all, from where they
// started.
void change(
    const Instance& original, double share, double step, std::mt19937_64& random, Instance& now) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto [lowest, highest] = std::minmax_element(original.cost.begin(), original.cost.end());
  const double most = original.cost.empty() ? 0 : step * (*highest - *lowest);
  const std::size_t num_rows = original.row_outside.size();
  const std::size_t num_moved =
      static_cast<std::size_t>(std::ceil(share * static_cast<double>(num_rows)));
  const std::size_t first = random() % std::max<std::size_t>(1, num_rows);
  for (std::size_t n = 0; n < num_moved; ++n) {
    const std::size_t i = (first + n * (num_rows / num_moved)) % num_rows;
    for (std::size_t k = now.row_start[i]; k < now.row_start[i + 1]; ++k) {
      now.cost[k] = original.cost[k] + most * uniform(random);
    }
  }
}

void print(double figure) {
  std::printf("%.17g\n", figure);
  std::fflush(stdout);
}

void run(nda::Assign2dMethod method, const Instance& instance, double limit_s) {
  const auto solver = nda::make_assign2d_solver(method);
  nda::Assign2dResult result;
  const double cold = median_time(
      limit_s, [] {}, [&] { solver->solve(instance.view(), result); });
  print(result.cost);
  print(cold);
  std::mt19937_64 random(1);
  constexpr double kShare[2] = {0.01, 1};
  constexpr double kStep[2] = {0.1, 0.001};
  for (int kind = 0; kind < 2; ++kind) {
    Instance now = instance;
    solver->solve(now.view(), result);
    print(median_time(
        limit_s,
        [&] { change(instance, kShare[kind], kStep[kind], random, now); },
        [&] { solver->solve_warm(now.view(), result); }));
  }
}

const std::map<std::string, nda::Assign2dMethod> kMethods = {
    {"shortest-path", nda::Assign2dMethod::kShortestPath},
    {"auction", nda::Assign2dMethod::kAuction},
    {"network-simplex", nda::Assign2dMethod::kNetworkSimplex}};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || kMethods.count(argv[2]) == 0) {
    std::fprintf(
        stderr, "usage: assign2d_benchmark FILE shortest-path|auction|network-simplex [SECONDS]\n");
    return 2;
  }
  run(kMethods.at(argv[2]), read_instance(argv[1]), argc > 3 ? std::atof(argv[3]) : 0.3);
  return 0;
}
