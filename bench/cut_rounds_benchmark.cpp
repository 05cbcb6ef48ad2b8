// Cuts over three indices as rows of the Lagrangian dual, or of a linear program?
//
//   build/release/bench/cut_rounds_benchmark [--limit S] [--solve S] FILE...
//
// Of the largest component of every file, with the arcs that the multipliers of the relaxation
// leave below the best cost that a solve of S seconds (default 5) finds, the gap is what lies
// between that cost and the bound of the relaxation.  Prints one row of a table in Markdown: the
// share of it that the exact linear program closes without cuts and, by cuts over three indices
// alone, with them, and the share that rounds of the volume algorithm close, which average relaxed
// solutions to find the same kind of cuts (rows/cut_rounds.hpp); then the linear program once more,
// begun with the cuts of the rounds.  Seconds are those of the processor; each way has S of the
// clock (default 30).  "-": it had no bound by then.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/component.hpp"
#include "core/shift.hpp"
#include "cutting/cut_loop.hpp"
#include "decompose/components.hpp"
#include "nda/io.hpp"
#include "nda/solve.hpp"
#include "relax/lagrangian.hpp"
#include "rows/cut_rounds.hpp"

namespace {

using nda::core::ArcId;
using nda::core::Component;

// What the pipeline does (solve/component_solver.cpp).
constexpr int kLeastEvaluations = 50;
constexpr int kMostEvaluations = 300;
constexpr std::size_t kIndicesPerEvaluation = 25;

struct Settings {
  double limit_s = 30;
  double solve_s = 5;
};

// Bounds of one way, and when they were there.
class Progress {
 public:
  void note(double lower) { points_.push_back({seconds(), lower}); }
  bool empty() const { return points_.empty(); }
  double first_s() const { return points_.front().seconds; }
  double first_lower() const { return points_.front().lower; }
  double last_s() const { return points_.back().seconds; }
  double last_lower() const { return points_.back().lower; }
  // The last bound by then; -inf if there was none.
  double lower_at(double time) const {
    double lower = -nda::kInfinity;
    for (const Point& point : points_) {
      if (point.seconds <= time) lower = point.lower;
    }
    return lower;
  }

 private:
  struct Point {
    double seconds;
    double lower;
  };
  double seconds() const { return static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC; }

  std::clock_t begin_ = std::clock();
  std::vector<Point> points_;
};

// The largest component of a problem, restricted to arcs that matter.
struct Start {
  Component component;
  std::vector<double> u;
  double lower = 0;
  double best = 0;

  double cutoff() const { return best - 1e-9 * std::abs(best); }
  double closed(double bound) const { return 100 * (bound - lower) / (best - lower); }
};

double best_cost(const nda::Problem& problem, const Component& component, double limit_s) {
  nda::Options options;
  options.time_limit_s = limit_s;
  const nda::Solution solution = nda::solve(problem, options);
  if (solution.solutions.empty()) return 0;
  const auto& arcs = solution.solutions.front().arcs;
  const std::set<std::vector<nda::Index>> used(arcs.begin(), arcs.end());
  double cost = 0;
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    if (used.count(problem.arc(component.arc_origin[a])) > 0) cost += component.costs[a];
  }
  return cost;
}

Start make_start(const nda::Problem& problem, double solve_s) {
  const nda::core::Shift shift = nda::core::make_shift(problem);
  const auto partition = nda::decompose::partition(problem, shift);
  std::size_t largest = 0;
  for (std::size_t c = 0; c < partition.num_components(); ++c) {
    if (partition.component(c).size() > partition.component(largest).size()) largest = c;
  }
  nda::core::Cutter cutter;
  const Component whole = cutter.cut(problem, shift, partition.component(largest));
  Start start;
  start.best = best_cost(problem, whole, solve_s);
  nda::relax::LagrangianOptions loop;
  const auto wanted = static_cast<int>(whole.num_indices() / kIndicesPerEvaluation);
  loop.max_evaluations = std::min(kMostEvaluations, std::max(kLeastEvaluations, wanted));
  loop.goal = start.cutoff();
  const nda::relax::LagrangianResult dual = nda::relax::maximize_dual(whole, {}, loop, {});
  start.lower = dual.lower;
  std::vector<ArcId> live;
  for (ArcId a = 0; a < whole.num_arcs(); ++a) {
    if (dual.lower + nda::core::reduced_cost(whole, dual.u, a) < start.cutoff()) live.push_back(a);
  }
  start.component = cutter.cut(whole, live);
  start.u = nda::core::restrict_slots(whole, dual.u, start.component);
  return start;
}

// `rows`: cuts to begin with.
Progress by_program(const Start& start,
                    double limit_s,
                    std::span<const nda::cutting::CutRow> rows) {
  Progress progress;
  nda::cutting::Master master(start.component, nda::core::all_arcs(start.component), start.u);
  for (const nda::cutting::CutRow& row : rows) master.add(row.cut);
  nda::cutting::CutLoopOptions options;
  options.cutoff = start.cutoff();
  options.most_patterns = 0;
  options.context.deadline = nda::core::Deadline(limit_s);
  nda::cutting::run_cut_loop(
      start.component, master, options, [&](const nda::cutting::Master& point) {
        progress.note(point.lower());
        return start.cutoff();
      });
  // A bound that ends it is not shown to the observer.
  if (master.lower() >= start.cutoff()) progress.note(start.best);
  return progress;
}

Progress by_averages(const Start& start, double limit_s, nda::rows::CutRoundsResult& result) {
  Progress progress;
  nda::rows::CutRoundOptions options;
  options.cutoff = start.cutoff();
  options.deadline = nda::core::Deadline(limit_s);
  result = nda::rows::run_cut_rounds(
      start.component, start.u, options, [&](const nda::rows::CutPoint& point) {
        progress.note(std::min(point.lower, start.best));
        return start.cutoff();
      });
  return progress;
}

void print(const Start& start, double lower) {
  if (lower == -nda::kInfinity)
    std::printf(" - |");
  else
    std::printf(" %.1f |", start.closed(lower));
}

void measure(const std::string& file, const Settings& settings) {
  const Start start = make_start(nda::read_problem(file), settings.solve_s);
  const std::string name = file.substr(file.find_last_of('/') + 1);
  const std::size_t num_arcs = start.component.num_arcs();
  std::printf("| %s | %zu | %zu |",
              name.substr(0, name.find(".nda")).c_str(),
              num_arcs,
              num_arcs == 0 ? 0 : start.component.num_indices());
  if (num_arcs == 0 || start.component.num_dimensions() < 3) {
    std::printf(" 0 | | | | | | | | | |\n");
    return;
  }
  std::printf(" %.2g |", 100 * (start.best - start.lower) / std::abs(start.best));
  nda::rows::CutRoundsResult result;
  const Progress averages = by_averages(start, settings.limit_s, result);
  const Progress program = by_program(start, settings.limit_s, {});
  const Progress from_there = by_program(start, settings.limit_s, result.rows);
  if (program.empty()) {
    std::printf(" - | - | - | - | - |");
  } else {
    std::printf(" %.3f |", program.first_s());
    print(start, program.first_lower());
    print(start, averages.lower_at(program.first_s()));
    std::printf(" %.3f |", program.last_s());
    print(start, program.last_lower());
  }
  if (averages.empty()) {
    std::printf(" - | - |");
  } else {
    std::printf(" %.3f |", averages.last_s());
    print(start, averages.last_lower());
  }
  std::printf(" %d |", result.evaluations);
  if (from_there.empty())
    std::printf(" - |\n");
  else
    std::printf(" %.3f |\n", from_there.last_s());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  std::printf(
      "| file | arcs | indices | gap, %% | program, s | closes, %% | averages by then, %% |"
      " with cuts, s | closes, %% | averages, s | close, %% | evaluations | program from there, s "
      "|\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (int n = 1; n < argc; ++n) {
    const std::string argument = argv[n];
    if (argument == "--limit" && n + 1 < argc)
      settings.limit_s = std::atof(argv[++n]);
    else if (argument == "--solve" && n + 1 < argc)
      settings.solve_s = std::atof(argv[++n]);
    else
      measure(argument, settings);
  }
}
