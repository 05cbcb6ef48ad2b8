// Times a two-dimensional solver on one problem; bench/assign2d.py writes the problem, runs this
// and compares with scipy.
//
//   assign2d_benchmark FILE METHOD [SECONDS]
//
// FILE: native-endian; num_rows, num_columns, num_pairs as 64-bit integers, row_start and column as
// 32-bit integers, cost, row_outside, column_outside as doubles.  METHOD: shortest-path, auction or
// network-simplex.  Prints cost, then microseconds cold, warm with few changes, warm with small
// changes everywhere (medians), each as soon as it is known.  A figure gets about SECONDS (default
// 0.3), and at least one run.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <map>
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

double now_us(clockid_t clock) {
  std::timespec time{};
  clock_gettime(clock, &time);
  return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

// Time of the processor, which other work on the machine does not lengthen; asking for it takes so
// long that the wall clock, if less, is nearer to the truth.
double microseconds(const std::function<void()>& action) {
  const double processor_begin = now_us(CLOCK_PROCESS_CPUTIME_ID);
  const double wall_begin = now_us(CLOCK_MONOTONIC);
  action();
  const double wall = now_us(CLOCK_MONOTONIC) - wall_begin;
  return std::min(wall, now_us(CLOCK_PROCESS_CPUTIME_ID) - processor_begin);
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
  const double cold = median(
      limit_s, [] {}, [&] { solver->solve(instance.view(), result); });
  print(result.cost);
  print(cold);
  std::mt19937_64 random(1);
  constexpr double kShare[2] = {0.01, 1};
  constexpr double kStep[2] = {0.1, 0.001};
  for (int kind = 0; kind < 2; ++kind) {
    Instance now = instance;
    solver->solve(now.view(), result);
    print(median(
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
