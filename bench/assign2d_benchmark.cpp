// Times the two-dimensional solvers on one problem; bench/assign2d.py writes the problem, runs this
// and compares with scipy.
//
//   assign2d_benchmark FILE [SECONDS]
//
// FILE: native-endian; num_rows, num_columns, num_pairs as 64-bit integers, row_start and column as
// 32-bit integers, cost, row_outside, column_outside as doubles.  One line per method on standard
// output: name, cost, microseconds cold, warm with few changes, warm with small changes everywhere
// (medians). A method gets about SECONDS (default 0.3) per figure, and at least one run.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "nda/assign2d.hpp"

namespace {

struct Instance {
  std::vector<std::uint32_t> row_start;
  std::vector<std::uint32_t> column;
  std::vector<double> cost;
  std::vector<double> row_outside;
  std::vector<double> column_outside;

  nda::Assign2dProblem view() const {
    return {row_start, column, cost, row_outside, column_outside};
  }
};

template <class T>
void read_array(std::ifstream& in, std::vector<T>& values, std::size_t size) {
  values.resize(size);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(size * sizeof(T)));
}

Instance read_instance(const char* path) {
  std::ifstream in(path, std::ios::binary);
  std::vector<std::uint64_t> sizes;
  read_array(in, sizes, 3);
  Instance instance;
  read_array(in, instance.row_start, sizes[0] + 1);
  read_array(in, instance.column, sizes[2]);
  read_array(in, instance.cost, sizes[2]);
  read_array(in, instance.row_outside, sizes[0]);
  read_array(in, instance.column_outside, sizes[1]);
  if (!in) throw std::runtime_error(std::string("cannot read ") + path);
  nda::validate(instance.view());
  return instance;
}

double microseconds(const std::function<void()>& action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin)
      .count();
}

// Median time of `action`, each time after `prepare`, within about limit_s.
double median(double limit_s,
              const std::function<void()>& prepare,
              const std::function<void()>& action) {
  constexpr std::size_t kMaxRuns = 101;
  std::vector<double> times;
  double total_us = 0;
  while (times.empty() || (total_us < 1e6 * limit_s && times.size() < kMaxRuns)) {
    prepare();
    times.push_back(microseconds(action));
    total_us += times.back();
  }
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  return times[times.size() / 2];
}

// Moves the costs of a share of the rows by up to step times the range of all, from where they
// started.
void change(
    const Instance& original, double share, double step, std::mt19937_64& random, Instance& now) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto [lowest, highest] = std::minmax_element(original.cost.begin(), original.cost.end());
  const double most = original.cost.empty() ? 0 : step * (*highest - *lowest);
  const std::size_t num_rows = original.row_outside.size();
  const std::size_t num_moved = static_cast<std::size_t>(std::ceil(share * num_rows));
  const std::size_t first = random() % std::max<std::size_t>(1, num_rows);
  for (std::size_t n = 0; n < num_moved; ++n) {
    const std::size_t i = (first + n * (num_rows / num_moved)) % num_rows;
    for (std::size_t k = now.row_start[i]; k < now.row_start[i + 1]; ++k) {
      now.cost[k] = original.cost[k] + most * uniform(random);
    }
  }
}

void run(const char* name, nda::Assign2dMethod method, const Instance& instance, double limit_s) {
  const auto solver = nda::make_assign2d_solver(method);
  nda::Assign2dResult result;
  const double cold = median(
      limit_s, [] {}, [&] { solver->solve(instance.view(), result); });
  const double cost = result.cost;
  std::mt19937_64 random(1);
  double warm[2];
  constexpr double kShare[2] = {0.01, 1};
  constexpr double kStep[2] = {0.1, 0.001};
  for (int kind = 0; kind < 2; ++kind) {
    Instance now = instance;
    solver->solve(now.view(), result);
    warm[kind] = median(
        limit_s,
        [&] { change(instance, kShare[kind], kStep[kind], random, now); },
        [&] { solver->solve_warm(now.view(), result); });
  }
  std::printf("%s %.17g %.2f %.2f %.2f\n", name, cost, cold, warm[0], warm[1]);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: assign2d_benchmark FILE [SECONDS]\n");
    return 2;
  }
  const Instance instance = read_instance(argv[1]);
  const double limit_s = argc > 2 ? std::atof(argv[2]) : 0.3;
  run("shortest-path", nda::Assign2dMethod::kShortestPath, instance, limit_s);
  run("auction", nda::Assign2dMethod::kAuction, instance, limit_s);
  run("network-simplex", nda::Assign2dMethod::kNetworkSimplex, instance, limit_s);
  return 0;
}
