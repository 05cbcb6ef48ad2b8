#include "mip/external_solver.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mip/process.hpp"
#include "mip/temporary_folder.hpp"
#include "nda/check.hpp"
#include "nda/io.hpp"

// Nothing a solver writes is believed before check() has seen it: the columns it names become arcs,
// their cost is recomputed, and an answer that is no solution is kWrong, its bound forgotten.  Only
// the bound itself has to be taken on trust; compare() sets it against what the others found.

namespace nda::mip {
namespace {

constexpr double kIntegerTolerance = 1e-4;
constexpr double kMostUses = UseBounds::kUnlimited;

constexpr ExternalKind kKinds[] = {
    {"cbc", "COIN-OR's branch and cut", "coinor-cbc", find_cbc},
    {"glpk", "GNU's linear programming kit", "glpk-utils", find_glpk},
    {"scipy", "HiGHS as scipy.optimize.milp", "python3-scipy", find_scipy},
    {"highs", "HiGHS as a program on the PATH", "none, see https://highs.dev", find_highs},
};

std::size_t count_columns(const Problem& problem) {
  std::size_t count = problem.num_arcs();
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    const auto costs = problem.singleton_costs(k);
    count += static_cast<std::size_t>(
        std::count_if(costs.begin() + 1, costs.end(), [](double c) { return c < kInfinity; }));
  }
  return count;
}

// Appends the arcs of the columns, and says what is wrong with these.  Singletons follow from the
// arcs.
std::string take_arcs(const Problem& problem,
                      const std::vector<RawAnswer::Column>& columns,
                      std::vector<std::vector<Index>>& arcs) {
  const auto same = [](const auto& a, const auto& b) { return a.number == b.number; };
  if (std::adjacent_find(columns.begin(), columns.end(), same) != columns.end())
    return "names a column twice";
  if (!columns.empty() && columns.back().number >= count_columns(problem))
    return "names a column that does not exist";
  for (const RawAnswer::Column& column : columns) {
    if (column.number >= problem.num_arcs()) break;
    if (column.value > 1) return "chooses an arc " + std::to_string(column.value) + " times";
    arcs.push_back(problem.arc(column.number));
  }
  return {};
}

void accept(const Problem& problem, const RawAnswer& raw, ExternalAnswer& answer) {
  std::vector<std::vector<Index>> arcs;
  const std::string fault = take_arcs(problem, raw.columns, arcs);
  if (!fault.empty()) {
    answer.status = ExternalStatus::kWrong;
    answer.note = fault;
    return;
  }
  Solution solution;
  solution.sizes.assign(problem.sizes().begin(), problem.sizes().end());
  solution.solutions.push_back({1, raw.objective, false, std::move(arcs)});
  solution.cost = raw.objective;
  const CheckReport report = check(problem, solution);
  if (!report.feasible) {
    answer.status = ExternalStatus::kWrong;
    answer.note = report.faults.front();
    return;
  }
  answer.cost = report.cost;
  answer.arcs = std::move(solution.solutions.front().arcs);
  if (std::abs(raw.objective - report.cost) > 1e-6 * std::max(1.0, std::abs(report.cost))) {
    char text[64];
    std::snprintf(text, sizeof text, "states the cost %.10g", raw.objective);
    answer.note = text;
  }
}

ExternalAnswer judge(const Problem& problem, const RawAnswer& raw, const ProcessResult& run) {
  ExternalAnswer answer;
  answer.status = raw.status;
  answer.seconds = run.seconds;
  if (run.ending == Ending::kTimeLimit) answer.status = ExternalStatus::kKilled;
  if (run.ending == Ending::kInterrupted) answer.status = ExternalStatus::kInterrupted;
  if (raw.has_solution && run.ending == Ending::kExited) accept(problem, raw, answer);
  if (answer.status == ExternalStatus::kWrong) return answer;
  answer.bound = answer.status == ExternalStatus::kInfeasible ? kInfinity : raw.bound;
  if (answer.status == ExternalStatus::kOptimal) {
    if (answer.cost == kInfinity) {
      answer.status = ExternalStatus::kFailed;
      answer.note = "says optimal without a solution";
    } else if (answer.bound == -kInfinity) {
      answer.bound = std::min(answer.cost, raw.objective);
    }
  } else if (answer.status == ExternalStatus::kFailed) {
    answer.note = "no answer, exit code " + std::to_string(run.exit_code);
  }
  return answer;
}

}  // namespace

const char* to_string(ExternalStatus status) {
  switch (status) {
    case ExternalStatus::kOptimal:
      return "optimal";
    case ExternalStatus::kTimeLimit:
      return "time_limit";
    case ExternalStatus::kKilled:
      return "killed";
    case ExternalStatus::kInterrupted:
      return "interrupted";
    case ExternalStatus::kInfeasible:
      return "infeasible";
    case ExternalStatus::kWrong:
      return "wrong";
    case ExternalStatus::kFailed:
      break;
  }
  return "failed";
}

void RawAnswer::take(std::size_t column, double value) {
  const double whole = std::nearbyint(value);
  if (!(std::abs(value - whole) <= kIntegerTolerance) || whole < 0 || whole > kMostUses) {
    has_solution = false;
  } else if (whole > 0) {
    columns.push_back({column, static_cast<std::size_t>(whole)});
  }
}

std::span<const ExternalKind> external_kinds() {
  return kKinds;
}

ExternalAnswer ExternalSolver::solve(const Problem& problem, const ExternalLimits& limits) const {
  ExternalAnswer answer;
  try {
    const TemporaryFolder folder(temporary_folder_);
    write_model(problem, folder.path());
    const double kill_s = 1.1 * limits.time_limit_s + limits.grace_s;
    const ProcessResult run =
        run_process(command(limits.time_limit_s), folder.path(), kLogFile, kill_s, limits.stop);
    if (run.ending == Ending::kNotStarted) {
      answer.note = "cannot be started";
    } else {
      answer = judge(problem, read_answer(folder.path()), run);
    }
  } catch (const InputError& error) {
    answer.note = error.what();
  }
  return answer;
}

void ExternalSolver::write_model(const Problem& problem, const std::string& folder) const {
  write_problem(problem, folder + "/" + kModelFile);
}

}  // namespace nda::mip
