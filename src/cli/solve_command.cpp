#include <chrono>
#include <csignal>
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include "cli/commands.hpp"
#include "cli/print.hpp"
#include "cli/progress_log.hpp"
#include "nda/io.hpp"
#include "nda/solve.hpp"

namespace nda::cli {
namespace {

struct SolveArguments {
  std::string file;
  std::string preset = "default";
  std::string method;
  std::string output;
  double time_limit_s = kInfinity;
  double gap = -1;
  double log_interval_s = 0.1;
  int threads = 1;
  std::uint64_t seed = 1;
  bool json = false;
  bool quiet = false;
  bool verbose = false;
};

// Set by the first Ctrl-C; the second kills, as usual.
volatile std::sig_atomic_t interrupted = 0;

void on_interrupt(int) {
  interrupted = 1;
  std::signal(SIGINT, SIG_DFL);
}

const std::map<std::string, Method> kMethods = {
    {"auto", Method::kAuto}, {"relaxation", Method::kRelaxation}, {"exact", Method::kExact}};

const std::map<std::string, DualMethod> kDualMethods = {{"bundle", DualMethod::kBundleTrust},
                                                        {"subgradient", DualMethod::kSubgradient},
                                                        {"volume", DualMethod::kVolume},
                                                        {"coordinate", DualMethod::kCoordinate}};

// --method takes the name of a way to solve or of a way to maximise the dual.
void set_method(const std::string& name, Options& options) {
  if (name.empty()) return;
  if (const auto method = kMethods.find(name); method != kMethods.end()) {
    options.method = method->second;
  } else if (const auto dual = kDualMethods.find(name); dual != kDualMethods.end()) {
    options.relaxation.dual_method = dual->second;
  } else {
    throw InputError("method '" + name +
                     "' is not known; there are auto, relaxation, exact, and for the dual bundle, "
                     "subgradient, volume, coordinate");
  }
}

Options make_options(const SolveArguments& arguments) {
  Options options = preset(arguments.preset);
  if (arguments.time_limit_s < kInfinity) options.time_limit_s = arguments.time_limit_s;
  if (arguments.gap >= 0) options.relative_gap = arguments.gap;
  options.num_threads = arguments.threads;
  options.seed = arguments.seed;
  set_method(arguments.method, options);
  validate(options);
  return options;
}

void print_components(const Solution& solution) {
  print("\n%10s %9s %8s %-10s %18s %18s  %s\n",
        "component",
        "arcs",
        "indices",
        "status",
        "cost",
        "lower bound",
        "method");
  for (std::size_t c = 0; c < solution.components.size(); ++c) {
    const ComponentReport& report = solution.components[c];
    print("%10zu %9zu %8zu %-10s %18.6f %18.6f  %s\n",
          c + 1,
          report.num_arcs,
          report.num_indices,
          to_string(report.status),
          report.cost,
          report.lower_bound,
          report.method.c_str());
  }
}

void print_summary(const Solution& solution) {
  print("status        %s\n", to_string(solution.status));
  if (!solution.reason.empty()) print("reason        %s\n", solution.reason.c_str());
  if (!solution.solutions.empty()) {
    print("cost          %.10g%s\n", solution.cost, solution.proven ? "  (proven optimal)" : "");
  }
  print("lower bound   %.10g%s\n",
        solution.lower_bound,
        solution.stats.bound_by_branching ? "  (by branching)" : "");
  if (!solution.solutions.empty()) {
    print("gap           %.3g  (%.3g %%)\n", solution.gap(), 100 * solution.relative_gap());
    print("arcs chosen   %zu\n", solution.solutions.front().arcs.size());
  }
  if (solution.stats.bound_by_branching) {
    print("certificate   %.10g  (by the multipliers alone)\n", solution.stats.certificate_bound);
  }
  print("components    %zu, %zu of %zu arcs after the cost shift\n",
        solution.num_components,
        solution.stats.arcs_after_shift,
        solution.num_arcs);
  print("work          %lld dual evaluations, %lld recoveries, %lld nodes\n",
        static_cast<long long>(solution.stats.dual_evaluations),
        static_cast<long long>(solution.stats.recoveries),
        static_cast<long long>(solution.stats.nodes));
  print("time          %.3f s reading, %.3f s solving\n",
        solution.stats.read_seconds,
        solution.stats.solve_seconds);
}

int exit_code(const Solution& solution) {
  if (solution.solutions.empty()) return kNoAnswer;
  const bool answered = solution.status == Status::kOptimal ||
                        solution.status == Status::kGapReached ||
                        solution.status == Status::kPrecisionLost;
  return answered ? kAnswer : kStopped;
}

int solve_file(const SolveArguments& arguments) {
  Options options = make_options(arguments);
  const auto begin = std::chrono::steady_clock::now();
  const Problem problem = read_problem(arguments.file);
  const double read_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ProgressLog log(std::cerr, arguments.log_interval_s);
  options.progress = [&](const Progress& progress) {
    if (!arguments.quiet && !arguments.json) log(progress);
    return interrupted == 0;
  };
  std::signal(SIGINT, on_interrupt);
  Solution solution = solve(problem, options);
  solution.stats.read_seconds = read_seconds;
  if (!arguments.output.empty()) write_solution(solution, arguments.output);
  if (arguments.json) {
    std::cout << solution_to_json(solution);
  } else {
    print_summary(solution);
    if (arguments.verbose) print_components(solution);
  }
  return exit_code(solution);
}

}  // namespace

Action declare_solve(CLI::App& parser) {
  const auto arguments = std::make_shared<SolveArguments>();
  parser.add_option("file", arguments->file, "arc file, '-' for standard input")->required();
  parser.add_option("--preset", arguments->preset, "realtime, default or exact");
  parser.add_option("--time-limit", arguments->time_limit_s, "seconds")->check(CLI::PositiveNumber);
  parser.add_option("--gap", arguments->gap, "stop at this relative gap (0.01 = 1 %)")
      ->check(CLI::NonNegativeNumber);
  parser.add_option("--threads", arguments->threads, "0 = all cores; the answer is the same")
      ->check(CLI::NonNegativeNumber);
  parser.add_option("--seed", arguments->seed, "of the randomised searches");
  parser.add_option("--method",
                    arguments->method,
                    "auto, relaxation, exact; or how the dual is maximised: bundle, subgradient, "
                    "volume, coordinate");
  parser.add_option("--output,-o", arguments->output, "write the solution as JSON");
  parser.add_flag("--json", arguments->json, "print the JSON alone");
  parser
      .add_option("--log-interval", arguments->log_interval_s, "seconds between lines of the log")
      ->check(CLI::NonNegativeNumber);
  parser.add_flag("--quiet,-q", arguments->quiet, "no solver log");
  parser.add_flag("--verbose,-v", arguments->verbose, "one line per component");
  parser.footer(
      "The log on standard error shows time, cost of the best assignment, lower bound and gap;\n"
      "the bound is proved by multipliers that `nda check` verifies.  Ctrl-C stops with the best "
      "so\n"
      "far.  Exit codes: 0 answer, 1 infeasible, 2 bad input, 3 stopped by a limit.\n"
      "\n"
      "Example:\n"
      "  nda solve window.nda.gz --time-limit 10 --output window.json\n"
      "  nda check window.nda.gz window.json");
  return [arguments] { return solve_file(*arguments); };
}

}  // namespace nda::cli
