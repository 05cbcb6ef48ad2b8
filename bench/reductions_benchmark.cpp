// What does every reduction remove, from components as they come and from what reduced costs leave?
//
//   build/release/bench/reductions_benchmark [--limit S] FILE...
//
// Prints two tables in Markdown, one row a file.  The first: all rules together on the components
// that the cost shift leaves; how many search.reductions=quick settles, and of how many all rules
// leave nothing.  The second, of components of more than 128 arcs: what is left when 50 evaluations
// of the dual function and the best solution that a solve of S seconds (default 5) finds have fixed
// what they can, how many arcs fixing drops (to zero) and takes (to one), into how many components
// that leaves it, and what the rules remove then.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bounded/split.hpp"
#include "core/component.hpp"
#include "core/shift.hpp"
#include "decompose/components.hpp"
#include "decompose/reduced_cost_fixing.hpp"
#include "nda/io.hpp"
#include "nda/solve.hpp"
#include "reduce/reducer.hpp"
#include "relax/lagrangian.hpp"

namespace {

using nda::ReductionYield;
using nda::core::ArcId;
using nda::core::Component;
using nda::reduce::Effort;

constexpr std::size_t kEnumeratedArcs = 128;
constexpr int kEvaluations = 50;

struct Row {
  std::string name;
  std::size_t indices = 0;
  std::size_t settled_quickly = 0;
  std::size_t settled = 0;
  std::size_t dropped = 0;  // by fixing
  std::size_t taken = 0;    // by fixing
  std::size_t parts = 0;    // after fixing
  ReductionYield yield;
};

void reduce(const Component& component, Row& row) {
  nda::reduce::Reducer reducer;
  row.settled_quickly += reducer.settle(component, Effort::kQuick).has_value();
  reducer.reduce(component, Effort::kAll);
  row.settled += reducer.yield().left == 0;
  row.yield += reducer.yield();
  row.indices += component.num_indices();
}

using Tuples = std::set<std::vector<nda::Index>>;

double cost_of(const Component& component, const nda::Problem& problem, const Tuples& best) {
  double cost = 0;
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    if (best.count(problem.arc(component.arc_origin[a])) > 0) cost += component.costs[a];
  }
  return cost;
}

// What reduced costs leave of a component, into the second table.
void fix_and_reduce(const Component& component, double cost, Row& row) {
  nda::relax::LagrangianOptions loop;
  loop.max_evaluations = kEvaluations;
  const nda::relax::LagrangianResult dual = nda::relax::maximize_dual(component, {}, loop, {});
  const double cutoff = cost - 1e-9 * std::abs(cost);
  if (dual.lower >= cutoff) return;
  const auto fixing = nda::decompose::fix(component, dual.u, dual.lower, cutoff);
  nda::core::Cutter cutter;
  const Component live = cutter.cut(component, fixing.live);
  row.dropped += component.num_arcs() - fixing.live.size() - fixing.taken.size();
  row.taken += fixing.taken.size();
  row.parts += nda::decompose::partition(live).num_components();
  reduce(live, row);
}

// Of a problem with bounds on uses what no bound couples.
nda::Problem without_bounds(nda::Problem problem) {
  if (!problem.is_many_to_one()) return problem;
  return std::move(*nda::bounded::split(problem, {}).rest);
}

void measure(const std::string& file, double limit_s, Row& first, Row& second) {
  const nda::Problem problem = without_bounds(nda::read_problem(file));
  nda::Options options;
  options.time_limit_s = limit_s;
  const nda::Solution solution = nda::solve(problem, options);
  Tuples best;
  if (!solution.solutions.empty())
    best.insert(solution.solutions.front().arcs.begin(), solution.solutions.front().arcs.end());
  const nda::core::Shift shift = nda::core::make_shift(problem);
  const auto partition = nda::decompose::partition(problem, shift);
  nda::core::Cutter cutter;
  for (std::size_t c = 0; c < partition.num_components(); ++c) {
    const Component component = cutter.cut(problem, shift, partition.component(c));
    reduce(component, first);
    if (component.num_arcs() <= kEnumeratedArcs || component.num_dimensions() == 2) continue;
    fix_and_reduce(component, cost_of(component, problem, best), second);
  }
}

std::string name_of(const std::string& file) {
  const std::string name = file.substr(file.find_last_of('/') + 1);
  return name.substr(0, name.find(".nda"));
}

void print_yield(const Row& row) {
  const ReductionYield& yield = row.yield;
  std::printf("%zu + %zu | %zu | %zu + %zu | %zu | %zu: %zu | %zu |",
              yield.outweighing,
              yield.excluded,
              yield.redundant,
              yield.single,
              yield.unprofitable,
              yield.dominated,
              yield.sides,
              yield.side_arcs,
              yield.left);
}

constexpr const char* kYieldColumns =
    "outweighing + excluded | redundant indices | single + unprofitable | dominated |"
    " sides: arcs | arcs left |";

void print_first(const std::vector<Row>& rows) {
  std::printf("| file | components | indices | arcs | %s settled quickly | settled |\n",
              kYieldColumns);
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Row& row : rows) {
    std::printf("| %s | %zu | %zu | %zu | ",
                row.name.c_str(),
                row.yield.components,
                row.indices,
                row.yield.arcs);
    print_yield(row);
    std::printf(" %zu | %zu |\n", row.settled_quickly, row.settled);
  }
}

void print_second(const std::vector<Row>& rows) {
  std::printf(
      "\n| file | components | dropped by fixing | taken by fixing | parts | indices | arcs | %s\n",
      kYieldColumns);
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Row& row : rows) {
    if (row.yield.components == 0) continue;
    std::printf("| %s | %zu | %zu | %zu | %zu | %zu | %zu | ",
                row.name.c_str(),
                row.yield.components,
                row.dropped,
                row.taken,
                row.parts,
                row.indices,
                row.yield.arcs);
    print_yield(row);
    std::printf("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  double limit_s = 5;
  std::vector<Row> first;
  std::vector<Row> second;
  for (int n = 1; n < argc; ++n) {
    if (std::string(argv[n]) == "--limit" && n + 1 < argc) {
      limit_s = std::atof(argv[++n]);
      continue;
    }
    first.emplace_back().name = second.emplace_back().name = name_of(argv[n]);
    measure(argv[n], limit_s, first.back(), second.back());
  }
  print_first(first);
  print_second(second);
}
