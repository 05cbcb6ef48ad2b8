// Time of the bundle master problem, cold and warm, and of a whole evaluation's bookkeeping.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/random.hpp"
#include "dual/bundle.hpp"
#include "dual/nlopt_simplex_qp.hpp"
#include "dual/simplex_qp.hpp"

namespace nda::dual {
namespace {

/// A sequence of programs as a bundle produces them: subgradients with entries in {1, 0, -1} of
/// which some repeat, and linear terms that change a little from one program to the next.
class Programs {
 public:
  Programs(std::size_t size, std::size_t count) : size_(size), gram_(size * size) {
    core::Random random(size);
    std::vector<std::vector<double>> columns;
    for (std::size_t i = 0; i < size; ++i) {
      std::vector<double> column(40);
      for (double& x : column) x = static_cast<double>(random.below(3)) - 1;
      if (i > 0 && random.below(5) == 0)
        column = columns[static_cast<std::size_t>(random.below(i))];
      columns.push_back(column);
    }
    for (std::size_t i = 0; i < size * size; ++i) {
      const std::vector<double>& a = columns[i / size];
      gram_[i] = std::inner_product(a.begin(), a.end(), columns[i % size].begin(), 0.0);
    }
    std::vector<double> linear(size);
    for (double& x : linear) x = random.uniform(0, 20);
    for (std::size_t p = 0; p < count; ++p) {
      for (double& x : linear) x = std::max(0.0, x + random.uniform(-1, 1));
      linear_.push_back(linear);
    }
  }

  SimplexQpProblem problem(std::size_t p) const {
    return {size_, gram_, size_, linear_[p % linear_.size()]};
  }

 private:
  std::size_t size_;
  std::vector<double> gram_;
  std::vector<std::vector<double>> linear_;
};

template <class Solver>
void solve_cold(benchmark::State& state) {
  const Programs programs(static_cast<std::size_t>(state.range(0)), 16);
  std::vector<double> weights(static_cast<std::size_t>(state.range(0)));
  Solver solver;
  std::size_t p = 0;
  for (auto _ : state) {
    std::fill(weights.begin(), weights.end(), 0.0);
    benchmark::DoNotOptimize(solver.solve(programs.problem(p++), weights).multiplier);
  }
}

template <class Solver>
void solve_warm(benchmark::State& state) {
  const Programs programs(static_cast<std::size_t>(state.range(0)), 16);
  std::vector<double> weights(static_cast<std::size_t>(state.range(0)));
  Solver solver;
  std::size_t p = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(solver.solve(programs.problem(p++), weights).multiplier);
  }
}

BENCHMARK_TEMPLATE(solve_cold, ActiveSetQp)->Arg(5)->Arg(10)->Arg(20)->Arg(30)->Arg(50);
BENCHMARK_TEMPLATE(solve_warm, ActiveSetQp)->Arg(5)->Arg(10)->Arg(20)->Arg(30)->Arg(50);
BENCHMARK_TEMPLATE(solve_cold, NloptSimplexQp)->Arg(5)->Arg(10)->Arg(20)->Arg(30)->Arg(50);
BENCHMARK_TEMPLATE(solve_warm, NloptSimplexQp)->Arg(5)->Arg(10)->Arg(20)->Arg(30)->Arg(50);

/// Everything a step does except the evaluation: n variables, a full bundle of 40.
void bundle_step(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  core::Random random(1);
  Bundle bundle(n, 40, 0);
  std::vector<double> pattern(2 * n);
  for (double& x : pattern) x = static_cast<double>(random.below(3)) - 1;
  std::size_t shift = 0;
  for (auto _ : state) {
    shift = (shift + 7) % n;
    std::copy_n(
        pattern.begin() + static_cast<std::ptrdiff_t>(shift), n, bundle.candidate().begin());
    bundle.measure_candidate();
    bundle.insert_candidate(0.5, 1);
    bundle.solve(1.0 / static_cast<double>(n));
    benchmark::DoNotOptimize(bundle.predicted_increase());
  }
}

BENCHMARK(bundle_step)->Arg(10)->Arg(100)->Arg(1000)->Arg(10000)->Arg(100000);

}  // namespace
}  // namespace nda::dual

BENCHMARK_MAIN();
