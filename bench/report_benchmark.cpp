// The experiments of the AFOSR report (1995), section 5, again; bench/report.py draws them.
//
//   report_benchmark arcs [PROBLEMS]     figure 5.1: time against arcs, 20 nonsmooth steps
//   report_benchmark steps [PROBLEMS]    figure 5.2: time against nonsmooth steps, 100,000 arcs
//   report_benchmark quality [PROBLEMS]  figure 5.3: recovered value, dual value, randomised
//   greedy;
//                                        optimum = 100
//
// Output is CSV.  As in the report, every problem of three or more dimensions takes the same number
// of nonsmooth steps, recovery follows the last one, and at three dimensions every one.  For
// figure 5.3 recovery at every step of the four-dimensional problem is shown as well.
//
// A time is the least of many runs of the same problem, summed over the problems.  The runs go
// round: every point of a figure once, then all again, so that a slow spell of the machine, which
// may last for seconds, meets all points and not one.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/component.hpp"
#include "core/shift.hpp"
#include "decompose/components.hpp"
#include "nda/baselines.hpp"
#include "nda/generate.hpp"
#include "nda/solve.hpp"
#include "recovery/recursive.hpp"
#include "relax/collapse.hpp"
#include "relax/lagrangian.hpp"

namespace {

using nda::core::Component;

struct Run {
  double seconds = 0;           // of the processor
  double collapse_seconds = 0;  // the same, of as many cost evaluations alone
  double recovered = 0;         // shifted
  double dual = 0;              // shifted
};

double seconds_since(std::clock_t begin) {
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

// A clock of the processor is too slow to be read around every cost evaluation of a run, and the
// wall clock counts what else the machine does: so they are timed by themselves, all at once.
double time_collapse(const Component& component, std::span<const double> u, int evaluations) {
  const nda::relax::Cells cells = nda::relax::find_cells(component);
  std::vector<double> d(cells.num_cells());
  std::vector<nda::core::ArcId> from(cells.num_cells());
  const std::clock_t begin = std::clock();
  for (int e = 0; e < evaluations; ++e) nda::relax::collapse(component, cells, u, d, from);
  return seconds_since(begin);
}

// The report's algorithm with m = 2: maximise, then recover.
Run relax_and_recover(const Component& component, int steps, double tolerance, int interval) {
  nda::relax::LagrangianOptions loop;
  loop.max_evaluations = steps;
  loop.relative_tolerance = tolerance;
  loop.recovery_interval = interval;
  nda::RelaxationOptions recovery;
  recovery.recovery_evaluations = steps;
  recovery.relative_tolerance = tolerance;
  Run run;
  const std::clock_t begin = std::clock();
  const auto result =
      nda::relax::maximize_dual(component, {}, loop, [&](const nda::relax::RelaxedDual& point) {
        return nda::recovery::recover_recursively(component, point, recovery, {});
      });
  run.seconds = seconds_since(begin);
  run.collapse_seconds = time_collapse(component, result.u, result.evaluations);
  run.recovered = result.best.cost;
  run.dual = result.lower;
  return run;
}

using Components = std::vector<Component>;

Components components_of(const nda::Problem& problem) {
  const nda::core::Shift shift = nda::core::make_shift(problem);
  const auto partition = nda::decompose::partition(problem, shift);
  Components components;
  nda::core::Cutter cutter;
  for (std::size_t c = 0; c < partition.num_components(); ++c) {
    components.push_back(cutter.cut(problem, shift, partition.component(c)));
  }
  return components;
}

Run total(const Components& components, int steps, double tolerance, int interval) {
  Run sum;
  for (const Component& component : components) {
    const Run run = relax_and_recover(component, steps, tolerance, interval);
    sum.seconds += run.seconds;
    sum.collapse_seconds += run.collapse_seconds;
    sum.recovered += run.recovered;
    sum.dual += run.dual;
  }
  return sum;
}

constexpr int kRounds = 25;

struct Point {
  std::size_t arcs;
  int steps;
};

// The same sizes of dimensions for the same number of the problem, whatever the number of arcs.
std::vector<Components> draw_problems(std::size_t arcs, int count) {
  std::vector<Components> problems;
  for (int seed = 1; seed <= count; ++seed) {
    nda::PooreSparseOptions options;
    options.min_size = 20;
    options.max_size = 30;
    options.arcs = arcs;
    options.seed = static_cast<std::uint64_t>(seed);
    problems.push_back(components_of(nda::generate_poore_sparse(options).problem));
  }
  return problems;
}

void print_mean_times(const std::vector<Point>& points, int count) {
  std::map<std::size_t, std::vector<Components>> problems;
  for (const Point& point : points) {
    auto& drawn = problems[point.arcs];
    if (drawn.empty()) drawn = draw_problems(point.arcs, count);
  }
  const std::size_t num_problems = static_cast<std::size_t>(count);
  std::vector<Run> least(points.size() * num_problems, {nda::kInfinity, nda::kInfinity});
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < least.size(); ++i) {
      const Point& point = points[i / num_problems];
      const Run run = total(problems[point.arcs][i % num_problems], point.steps, 0.0, 0);
      least[i].seconds = std::min(least[i].seconds, run.seconds);
      least[i].collapse_seconds = std::min(least[i].collapse_seconds, run.collapse_seconds);
    }
  }
  std::printf("arcs,steps,total_ms,collapse_ms\n");
  for (std::size_t p = 0; p < points.size(); ++p) {
    Run sum;
    for (std::size_t i = p * num_problems; i < (p + 1) * num_problems; ++i) {
      sum.seconds += least[i].seconds;
      sum.collapse_seconds += least[i].collapse_seconds;
    }
    const double scale = 1e3 / count;
    std::printf("%zu,%d,%.6f,%.6f\n",
                points[p].arcs,
                points[p].steps,
                scale * sum.seconds,
                scale * sum.collapse_seconds);
  }
}

void time_against_arcs(int problems) {
  std::vector<Point> points;
  for (std::size_t arcs = 20000; arcs <= 200000; arcs += 20000) points.push_back({arcs, 20});
  print_mean_times(points, problems);
}

void time_against_steps(int problems) {
  std::vector<Point> points;
  for (int steps = 10; steps <= 100; steps += 10) points.push_back({100000, steps});
  print_mean_times(points, problems);
}

// Steps to convergence: the report's average.
constexpr int kConvergence = 200;

// How the problem class of figure 5.3 may be read.
struct Reading {
  const char* name;
  bool dummies;  // tuples with dummies and priced singletons, or full tuples and a perfect
                 // assignment
  bool shifted;  // figures relative to the shifted optimum
};

constexpr Reading kReadings[] = {{"dummies priced; costs as given", true, false},
                                 {"dummies priced; costs shifted", true, true},
                                 {"full tuples; costs as given", false, false},
                                 {"full tuples; costs shifted", false, true}};

// A quarter of the full tuples, costs uniform in [1, 100]; nothing may stay alone.
nda::Problem full_tuples(std::uint64_t seed) {
  nda::PooreSparseOptions options;
  options.min_size = options.max_size = 7;
  options.arcs = 7 * 7 * 7 * 7 / 4;
  options.seed = seed;
  const nda::Problem drawn = nda::generate_poore_sparse(options).problem;
  nda::ProblemBuilder builder({drawn.sizes().begin(), drawn.sizes().end()});
  for (std::size_t a = 0; a < drawn.num_arcs(); ++a) {
    builder.add_arc(drawn.arc(a), drawn.costs()[a] + 101);
  }
  std::vector<nda::Index> tuple(4, 0);
  for (std::size_t k = 0; k < 4; ++k) {
    for (nda::Index i = 1; i <= drawn.sizes()[k]; ++i) {
      tuple[k] = i;
      builder.add_arc(tuple, nda::kInfinity);
    }
    tuple[k] = 0;
  }
  return std::move(builder).build();
}

nda::Problem priced_dummies(std::uint64_t seed) {
  nda::PooreDenseOptions options;
  options.min_size = 5;
  options.max_size = 9;
  options.seed = seed;
  return nda::generate_poore_dense(options).problem;
}

void print_quality(const Reading& reading, int number) {
  const auto seed = static_cast<std::uint64_t>(number);
  const nda::Problem problem = reading.dummies ? priced_dummies(seed) : full_tuples(seed);
  const nda::Solution optimum = nda::solve(problem);
  if (optimum.solutions.empty()) return;
  const nda::core::Shift shift = nda::core::make_shift(problem);
  const Components components = components_of(problem);
  const Run last = total(components, kConvergence, 1e-7, 0);
  const Run every = total(components, kConvergence, 1e-7, 1);
  const nda::BaselineResult greedy = nda::solve_randomized_greedy(problem);
  // "Shifted" means relative to the worst there is: everything alone, or every tuple at 100.
  const double zero = !reading.shifted ? 0.0 : reading.dummies ? shift.constant : 7 * 100.0;
  const double scale = 100 / (optimum.cost - zero);
  const auto normalise = [&](double cost) { return scale * (cost - zero); };
  // A recovered packing that still pays a penalty is not feasible.
  const auto recovered = [&](const Run& run) {
    const double cost = shift.constant + run.recovered;
    return shift.penalty == 0 || cost < shift.penalty ? normalise(cost) : std::nan("");
  };
  std::printf("%s,%d,%.4f,%.4f,%.4f,%.4f,%d\n",
              reading.name,
              number,
              recovered(last),
              recovered(every),
              normalise(shift.constant + every.dual),
              greedy.feasible ? normalise(greedy.cost) : std::nan(""),
              optimum.proven ? 1 : 0);
  std::fflush(stdout);
}

void quality(int problems) {
  std::printf("reading,problem,recovered_last,recovered_every,dual,greedy,proven\n");
  for (const Reading& reading : kReadings) {
    for (int number = 1; number <= problems; ++number) print_quality(reading, number);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const int problems = argc > 2 ? std::atoi(argv[2]) : (what == "quality" ? 50 : 10);
  if (what == "arcs") {
    time_against_arcs(problems);
  } else if (what == "steps") {
    time_against_steps(problems);
  } else if (what == "quality") {
    quality(problems);
  } else {
    std::fprintf(stderr, "usage: report_benchmark arcs|steps|quality [PROBLEMS]\n");
    return 2;
  }
}
