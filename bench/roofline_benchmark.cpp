// Arcs a second of the passes over arcs, against what one core of this machine can load.  Prints
// the tables of docs/benchmarks/roofline.md; bench/roofline.py puts them there.
//
//   taskset -c 0 roofline_benchmark
//
// Times are of the processor, each the least of some runs: other work on the machine takes caches
// and bandwidth away, but never gives any.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "core/min_max.hpp"
#include "core/reduced_costs.hpp"
#include "decompose/components.hpp"
#include "nda/generate.hpp"
#include "relax/collapse.hpp"
#include "relax/dual_function.hpp"
#include "relax/lagrangian.hpp"
#include "roofline_variants.hpp"

namespace {

using nda::core::Component;

constexpr std::size_t kCachedArcs = 5000;
constexpr int kEvaluations = 10;
constexpr int kMarked = 5;  // dimensions
constexpr double kWantedRate = 1e9;
constexpr double kWantedShare = 0.45;

double processor_s() {
  std::timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Seconds of one action, the least of several runs of some milliseconds or more.
double seconds(const std::function<void()>& action) {
  constexpr double kRun_s = 0.004;
  constexpr double kTotal_s = 0.25;
  constexpr int kLeastRuns = 5;
  int repeats = 1;
  double least = 1e30;
  double total = 0;
  for (int run = 0; run < kLeastRuns || total < kTotal_s; ++run) {
    const double begin = processor_s();
    for (int n = 0; n < repeats; ++n) action();
    const double taken = processor_s() - begin;
    total += taken;
    if (taken < kRun_s / 2) {
      repeats *= 2;
      run = -1;
    } else {
      least = std::min(least, taken / repeats);
    }
  }
  return least;
}

struct Machine {
  double triad = 0;         // bytes a second
  double double_loads = 0;  // of the first-level cache, a second
  double loads = 0;         // of any kind
};

// STREAM's triad over three arrays of 64 MiB.
double measure_triad() {
  std::vector<double> a(std::size_t{8} << 20);
  std::vector<double> b(a.size(), 1.0);
  std::vector<double> c(a.size(), 2.0);
  const double s = seconds([&] {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = b[i] + 3.0 * c[i];
  });
  if (a[a.size() / 2] != 7) std::abort();
  return static_cast<double>(3 * sizeof(double) * a.size()) / s;
}

// Volatile, or nothing would be loaded.
template <typename Number>
double measure_loads() {
  std::vector<Number> values(1024, Number{1});
  constexpr std::size_t kRounds = 64;
  const double s = seconds([&] {
    for (std::size_t round = 0; round < kRounds; ++round) {
      for (const volatile Number* v = values.data(); v != values.data() + values.size(); v += 16) {
        v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7];
        v[8], v[9], v[10], v[11], v[12], v[13], v[14], v[15];
      }
    }
  });
  return static_cast<double>(kRounds * values.size()) / s;
}

// The best of what was seen so far and what is seen now.
void measure(Machine& machine) {
  machine.triad = std::max(machine.triad, measure_triad());
  machine.double_loads = std::max(machine.double_loads, measure_loads<double>());
  machine.loads = std::max(machine.loads, measure_loads<std::uint32_t>());
}

// Columns and costs that a pass over all dimensions, or over the relaxed ones, reads once.
double bytes_per_arc(int dimensions) {
  return 8.0 + 4.0 * dimensions;
}

// Arcs a second if the ports that load were all there is: a cost and a multiplier per dimension as
// doubles, the indices besides, those of two arcs at once.
double load_limit(const Machine& machine, int dimensions) {
  const double s =
      std::max((1.0 + dimensions) / machine.double_loads, (1.0 + 1.5 * dimensions) / machine.loads);
  return 1 / s;
}

struct Case {
  std::string name;
  std::unique_ptr<Component> component;
  std::vector<double> u;
};

// With the multipliers of some evaluations, as most are evaluated near such.
Case make_case(std::string name, Component component) {
  Case made{std::move(name), std::make_unique<Component>(std::move(component)), {}};
  nda::relax::LagrangianOptions loop;
  loop.max_evaluations = kEvaluations;
  loop.certify = false;
  made.u = nda::relax::maximize_dual(*made.component, {}, loop, {}).u;
  return made;
}

// The part nearest to so many arcs.
Component part_of_about(const nda::Problem& problem, std::size_t arcs) {
  const nda::core::Shift shift = nda::core::make_shift(problem);
  const nda::decompose::Partition parts = nda::decompose::partition(problem, shift);
  std::size_t best = 0;
  const auto distance = [&](std::size_t p) {
    const std::size_t size = parts.component(p).size();
    return size > arcs ? size - arcs : arcs - size;
  };
  for (std::size_t p = 1; p < parts.num_components(); ++p) {
    if (distance(p) < distance(best)) best = p;
  }
  return nda::core::Cutter().cut(problem, shift, parts.component(best));
}

Component whole(const nda::Problem& problem) {
  const nda::core::Shift shift = nda::core::make_shift(problem);
  std::vector<nda::core::ArcId> arcs(problem.num_arcs());
  std::iota(arcs.begin(), arcs.end(), 0u);
  return nda::core::Cutter().cut(problem, shift, arcs);
}

nda::Problem groups(int scans, int targets, double side) {
  nda::TrackingOptions options = nda::tracking_preset("largegroup");
  options.scans = scans;
  options.targets = targets;
  options.side = side;
  return nda::generate_tracking(options).problem;
}

nda::Problem planted(int dimensions, nda::Index size, std::size_t arcs) {
  nda::PlantedOptions options;
  options.dimensions = dimensions;
  options.size = size;
  options.arcs = arcs;
  return nda::generate_planted(options).problem;
}

std::vector<Case> make_cases(int dimensions) {
  std::vector<Case> cases;
  cases.push_back(
      make_case("groups, cache", part_of_about(groups(dimensions, 400, 9000), kCachedArcs)));
  cases.push_back(make_case("planted, cache", whole(planted(dimensions, 100, kCachedArcs))));
  if (dimensions == 5)
    cases.push_back(make_case("groups, memory", whole(groups(dimensions, 8000, 40000))));
  cases.push_back(make_case("planted, memory", whole(planted(dimensions, 80000, 4000000))));
  return cases;
}

// "730 (36 %, 53 %)": million arcs a second, of the triad's bytes, of the load limit.
std::string figure(const Machine& machine, double rate, int dimensions) {
  char text[64];
  std::snprintf(text,
                sizeof text,
                "%.0f (%.0f %%, %.0f %%)",
                1e-6 * rate,
                100 * rate * bytes_per_arc(dimensions) / machine.triad,
                100 * rate / load_limit(machine, dimensions));
  return text;
}

double collapse_rate(const Case& made, const nda::relax::Cells& cells) {
  std::vector<double> d(cells.num_cells());
  std::vector<nda::core::ArcId> from(cells.num_cells());
  const std::size_t arcs = made.component->num_arcs() - cells.num_free();
  return static_cast<double>(arcs) /
         seconds([&] { nda::relax::collapse(*made.component, cells, made.u, d, from); });
}

double evaluation_rate(const Case& made) {
  nda::relax::DualFunction function(*made.component);
  std::vector<double> subgradient(function.num_variables());
  const auto u = std::span(made.u).subspan(function.first_slot());
  return static_cast<double>(made.component->num_arcs()) /
         seconds([&] { function.evaluate(u, subgradient); });
}

double feasible_rate(const Case& made) {
  std::vector<double> u = made.u;
  return static_cast<double>(made.component->num_arcs()) /
         seconds([&] { nda::relax::make_feasible(*made.component, u); });
}

double reduced_rate(const Case& made) {
  double least = 0;
  const double s = seconds([&] {
    nda::core::for_each_reduced_cost(*made.component, made.u, {}, [&](nda::core::ArcId, double r) {
      least = nda::core::min_of(least, r);
    });
  });
  if (std::isnan(least)) std::abort();
  return static_cast<double>(made.component->num_arcs()) / s;
}

// One problem's figures; rates are arcs a second.
struct Row {
  std::string name;
  int dimensions;
  std::size_t arcs;
  double arcs_per_cell;
  double collapse;
  double evaluation;
  double reduced;
  double feasible;
};

Row measure_row(const Case& made) {
  const nda::relax::Cells cells = nda::relax::find_cells(*made.component);
  const std::size_t arcs = made.component->num_arcs();
  return {made.name,
          made.component->num_dimensions(),
          arcs,
          static_cast<double>(arcs - cells.num_free()) / static_cast<double>(cells.num_cells()),
          collapse_rate(made, cells),
          evaluation_rate(made),
          reduced_rate(made),
          feasible_rate(made)};
}

void print_rows(const Machine& machine, const std::vector<Row>& rows) {
  std::printf(
      "Triad %.1f GB/s; loads from the first-level cache: %.2f doubles, %.2f integers a ns.\n\n",
      1e-9 * machine.triad,
      1e-9 * machine.double_loads,
      1e-9 * machine.loads);
  std::printf(
      "| problem | N | arcs | arcs a cell | bytes | collapse | evaluation | reduced costs | "
      "feasible "
      "|\n|---|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const Row& row : rows) {
    std::printf("| %s | %d | %zu | %.1f | %.0f | %s | %s | %s | %.0f |\n",
                row.name.c_str(),
                row.dimensions,
                row.arcs,
                row.arcs_per_cell,
                bytes_per_arc(row.dimensions - 2),
                figure(machine, row.collapse, row.dimensions - 2).c_str(),
                figure(machine, row.evaluation, row.dimensions - 2).c_str(),
                figure(machine, row.reduced, row.dimensions).c_str(),
                1e-6 * row.feasible);
  }
}

void print_variants(const std::vector<Case>& cases) {
  std::printf("\n| N = 5, million arcs a second |");
  for (const Case& made : cases) std::printf(" %s |", made.name.c_str());
  std::printf("\n|---|");
  for (std::size_t c = 0; c < cases.size(); ++c) std::printf("--:|");
  std::vector<nda::bench::Variant> all = nda::bench::variants();
  all.insert(all.begin(), {"as it is", nda::relax::collapse});
  for (const nda::bench::Variant& variant : all) {
    std::printf("\n| %s |", variant.name);
    for (const Case& made : cases) {
      const nda::relax::Cells cells = nda::relax::find_cells(*made.component);
      std::vector<double> d(cells.num_cells());
      std::vector<nda::core::ArcId> from(cells.num_cells());
      const double s = seconds([&] { variant.collapse(*made.component, cells, made.u, d, from); });
      const auto arcs = static_cast<double>(made.component->num_arcs() - cells.num_free());
      std::printf(" %.0f |", 1e-6 * arcs / s);
    }
  }
  std::printf("\n");
}

void print_verdict(const Machine& machine, const std::vector<Row>& rows) {
  const double by_triad = kWantedShare * machine.triad / bytes_per_arc(kMarked - 2);
  std::printf(
      "\nThe mark is %.0f million arcs a second at N = %d, or what %.0f %% of the triad is, %.0f.  "
      "Evaluations:\n\n",
      1e-6 * kWantedRate,
      kMarked,
      100 * kWantedShare,
      1e-6 * by_triad);
  for (const Row& row : rows) {
    if (row.dimensions != kMarked) continue;
    const bool reached = row.evaluation >= std::min(kWantedRate, by_triad);
    std::printf("- %s: %.0f, %s\n",
                row.name.c_str(),
                1e-6 * row.evaluation,
                reached ? "reached" : "missed");
  }
}

}  // namespace

int main() {
  Machine machine;
  std::vector<Case> marked;
  std::vector<Row> rows;
  for (int dimensions = 3; dimensions <= 8; ++dimensions) {
    measure(machine);
    std::vector<Case> cases = make_cases(dimensions);
    for (const Case& made : cases) rows.push_back(measure_row(made));
    if (dimensions == kMarked) marked = std::move(cases);
  }
  print_rows(machine, rows);
  print_variants(marked);
  print_verdict(machine, rows);
  return 0;
}
