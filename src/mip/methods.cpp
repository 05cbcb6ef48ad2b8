#include "mip/methods.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include "core/clock.hpp"
#include "core/option_table.hpp"
#include "core/use_bounds.hpp"
#include "mip/external_solver.hpp"
#include "nda/baselines.hpp"
#include "nda/check.hpp"
#include "nda/k_best.hpp"
#include "nda/solve.hpp"

// One table per kind says what there is; choose_methods() turns its lines into Contenders.  What a
// method returns is verified here, after its clock has stopped: our own answers with the whole of
// check(), bound included; those of the baselines for feasibility and cost; the external ones are
// verified by their adapter.

namespace nda::mip {
namespace {

constexpr std::size_t kEnumerationMaxArcs = 1000;

// The group of presets that follow papers.
constexpr const char* kPapers = "paper";

// It cannot be interrupted, and with twice as many arcs it takes hours in bad cases.
constexpr std::size_t kQuickBruteForceMaxArcs = 32;
static_assert(kQuickBruteForceMaxArcs <= kBruteForceMaxArcs);

Options relaxation_by(const char* dual_method) {
  Options options;
  core::set_option("method", "relaxation", options);
  core::set_option("relaxation.dual_method", dual_method, options);
  return options;
}

Options enumeration() {
  Options options;
  core::set_option("method", "exact", options);
  return options;
}

struct NdaMethod {
  const char* name;
  const char* about;
  Options (*options)();
};

// Partial branch and bound keeps a buffer of solutions, and cuts nothing before it is full.
constexpr std::size_t kBuffer = 10;

const NdaMethod kNdaMethods[] = {
    {"default", "preset default", [] { return preset("default"); }},
    {"exact", "preset exact", [] { return preset("exact"); }},
    {"realtime", "preset realtime, with its own time limit", [] { return preset("realtime"); }},
    {"enumeration", "branch and bound from the start (at most 1000 arcs)", enumeration},
    {"relaxation",
     "relaxation and recovery alone, dual by the bundle method",
     [] { return relaxation_by("bundle"); }},
    {"volume", "the same, dual by the volume algorithm", [] { return relaxation_by("volume"); }},
    {"subgradient",
     "the same, dual by subgradient steps",
     [] { return relaxation_by("subgradient"); }},
};

struct Baseline {
  const char* name;
  const char* about;
  BaselineResult (*solve)(const Problem&);
  bool exact;
  bool knows_bounds;  // on uses
};

const Baseline kBaselines[] = {
    {"greedy", "always the cheapest arc that fits", solve_greedy, false, true},
    {"random-greedy",
     "best of 100 greedy constructions with random choices",
     [](const Problem& problem) { return solve_randomized_greedy(problem); },
     false,
     false},
    {"max-regret", "always the index that loses most by waiting", solve_max_regret, false, false},
    {"sgts",
     "semi-greedy track selection",
     [](const Problem& problem) { return solve_sgts(problem); },
     false,
     false},
    {"brute-force",
     "all solutions (at most 32 arcs and 64 indices)",
     solve_brute_force,
     true,
     true},
};

std::string more_than(std::size_t limit, const char* what) {
  return "more than " + std::to_string(limit) + " " + what;
}

// Why a method that does not know bounds on uses is not meant for a problem that has some.
std::string bounds_fault(bool knows_bounds, const Problem& problem) {
  return knows_bounds ? std::string() : core::first_bounds(problem);
}

Solution as_solution(const Problem& problem, BaselineResult result) {
  Solution solution;
  solution.sizes.assign(problem.sizes().begin(), problem.sizes().end());
  solution.cost = result.cost;
  solution.solutions.push_back({1, result.cost, false, std::move(result.arcs)});
  return solution;
}

MethodResult run_nda(const Problem& problem, Options options, const RunLimits& limits) {
  options.relative_gap = 0;
  options.num_threads = 1;
  options.time_limit_s = std::min(options.time_limit_s, limits.time_limit_s);
  options.stop = limits.stop;
  MethodResult result;
  const core::Stopwatch watch;
  const Solution solution = options.ranking.method == RankingMethod::kExact
                                ? solve(problem, options)
                                : solve_k_best(problem, kBuffer, options);
  result.seconds = watch.seconds();
  result.status = to_string(solution.status);
  result.proven = solution.proven || solution.status == Status::kInfeasible;
  result.bound = solution.lower_bound;
  const CheckReport report = check(problem, solution);
  if (!report.passed()) {
    result.faulty = true;
    result.note = report.faults.front();
  }
  if (!solution.solutions.empty() && report.feasible) result.cost = report.cost;
  return result;
}

MethodResult run_baseline(const Problem& problem, const Baseline& baseline) {
  MethodResult result;
  const core::Stopwatch watch;
  BaselineResult found = baseline.solve(problem);
  result.seconds = watch.seconds();
  result.proven = baseline.exact;
  result.status = baseline.exact   ? found.feasible ? "optimal" : "infeasible"
                  : found.feasible ? "heuristic"
                                   : "no_solution";
  if (!found.feasible) {
    if (baseline.exact) result.bound = kInfinity;
    return result;
  }
  const CheckReport report = check(problem, as_solution(problem, std::move(found)));
  if (report.feasible && report.cost_right) {
    result.cost = report.cost;
    if (baseline.exact) result.bound = report.cost;
  } else {
    result.faulty = true;
    result.note = report.faults.front();
  }
  return result;
}

MethodResult run_external(const ExternalSolver& solver,
                          const Problem& problem,
                          const RunLimits& limits) {
  ExternalLimits external;
  external.time_limit_s = limits.time_limit_s;
  external.stop = limits.stop;
  ExternalAnswer answer = solver.solve(problem, external);
  MethodResult result;
  result.status = to_string(answer.status);
  result.proven =
      answer.status == ExternalStatus::kOptimal || answer.status == ExternalStatus::kInfeasible;
  result.cost = answer.cost;
  result.bound = answer.bound;
  result.bound_error = kExternalTolerance;
  result.seconds = answer.seconds;
  result.note = std::move(answer.note);
  return result;
}

Contender make_contender(const NdaMethod& line) {
  Contender method{line.name, MethodKind::kNda, line.about, {}, {}};
  const bool is_enumeration = std::string(line.name) == "enumeration";
  method.unfit = [is_enumeration](const Problem& problem) {
    return is_enumeration && problem.num_arcs() > kEnumerationMaxArcs
               ? more_than(kEnumerationMaxArcs, "arcs")
               : std::string();
  };
  method.run = [&line](const Problem& problem, const RunLimits& limits) {
    return run_nda(problem, line.options(), limits);
  };
  return method;
}

Contender make_contender(const PresetInfo& line) {
  Contender method{line.name, MethodKind::kNda, line.about, {}, {}};
  const bool knows_bounds = preset(line.name).ranking.method == RankingMethod::kExact;
  method.unfit = [knows_bounds](const Problem& problem) {
    return bounds_fault(knows_bounds, problem);
  };
  method.run = [&line](const Problem& problem, const RunLimits& limits) {
    return run_nda(problem, preset(line.name), limits);
  };
  return method;
}

Contender make_contender(const Baseline& line) {
  Contender method{line.name, MethodKind::kBaseline, line.about, {}, {}};
  method.unfit = [&line](const Problem& problem) {
    if (line.exact && problem.num_arcs() > kQuickBruteForceMaxArcs)
      return more_than(kQuickBruteForceMaxArcs, "arcs");
    if (line.exact && problem.num_indices() > kBruteForceMaxIndices)
      return more_than(kBruteForceMaxIndices, "indices");
    return bounds_fault(line.knows_bounds, problem);
  };
  method.run = [&line](const Problem& problem, const RunLimits&) {
    return run_baseline(problem, line);
  };
  return method;
}

Contender make_contender(const ExternalKind& line, std::shared_ptr<const ExternalSolver> solver) {
  Contender method{line.name, MethodKind::kExternal, line.about, {}, {}};
  method.run = [solver](const Problem& problem, const RunLimits& limits) {
    return run_external(*solver, problem, limits);
  };
  return method;
}

// Whether the names ask for this method.
bool is_asked(const std::vector<std::string>& names, const char* name, MethodKind kind) {
  return names.empty() || std::any_of(names.begin(), names.end(), [&](const std::string& asked) {
           return asked == name || asked == to_string(kind);
         });
}

// The algorithms of papers are run by name only: they are there to be seen side by side.
bool is_paper_asked(const std::vector<std::string>& names, const PresetInfo& line) {
  return line.is_paper && !names.empty() &&
         std::any_of(names.begin(), names.end(), [&](const std::string& asked) {
           return asked == line.name || asked == kPapers;
         });
}

void require_known(const std::vector<std::string>& names) {
  std::vector<std::string> known = method_names();
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  for (const MethodKind kind : {MethodKind::kNda, MethodKind::kBaseline, MethodKind::kExternal}) {
    known.push_back(to_string(kind));
  }
  known.push_back(kPapers);
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw InputError("method '" + name + "' is not known; there are " + list +
                     ", and the groups nda, paper, baseline, external");
  }
}

}  // namespace

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const NdaMethod& line : kNdaMethods) names.push_back(line.name);
  for (const PresetInfo& line : presets()) {
    if (line.is_paper) names.push_back(line.name);
  }
  for (const Baseline& line : kBaselines) names.push_back(line.name);
  for (const ExternalKind& line : external_kinds()) names.push_back(line.name);
  return names;
}

MethodChoice choose_methods(const std::vector<std::string>& names,
                            const Surroundings& surroundings) {
  require_known(names);
  MethodChoice choice;
  for (const NdaMethod& line : kNdaMethods) {
    if (is_asked(names, line.name, MethodKind::kNda))
      choice.methods.push_back(make_contender(line));
  }
  for (const PresetInfo& line : presets()) {
    if (is_paper_asked(names, line)) choice.methods.push_back(make_contender(line));
  }
  for (const Baseline& line : kBaselines) {
    if (is_asked(names, line.name, MethodKind::kBaseline)) {
      choice.methods.push_back(make_contender(line));
    }
  }
  for (const ExternalKind& line : external_kinds()) {
    if (!is_asked(names, line.name, MethodKind::kExternal)) continue;
    if (std::shared_ptr<const ExternalSolver> solver = line.find(surroundings)) {
      choice.methods.push_back(make_contender(line, std::move(solver)));
    } else {
      choice.missing.push_back(std::string(line.name) +
                               " is not installed (Debian package: " + line.package + ")");
    }
  }
  return choice;
}

}  // namespace nda::mip
