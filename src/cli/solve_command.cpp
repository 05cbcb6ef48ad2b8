#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "cli/print.hpp"
#include "cli/print_marginals.hpp"
#include "cli/print_yields.hpp"
#include "cli/progress_log.hpp"
#include "core/clock.hpp"
#include "core/option_table.hpp"
#include "core/shift.hpp"
#include "nda/io.hpp"
#include "nda/k_best.hpp"
#include "nda/marginals.hpp"
#include "nda/solve.hpp"

namespace nda::cli {
namespace {

// Of a number of dimensions, an int.
constexpr int kDimensionBits = std::numeric_limits<int>::digits;

// An option of the table and the text it is set to.
struct Setting {
  std::string name;
  std::string value;
};

struct SolveArguments {
  std::string file;
  std::string preset = "default";
  std::string method;
  std::string output;
  std::string proof;
  std::string warm_start;
  std::string save_warm_start;
  int shift = 0;
  int keep = 0;
  std::vector<Setting> settings;  // applied in this order
  std::size_t k = 1;
  double log_interval_s = 0.1;
  double cost_per_nat = 1;
  bool marginals = false;
  bool json = false;
  bool quiet = false;
  bool verbose = false;
};

constexpr std::size_t kShownRanks = 20;

// Set by the first Ctrl-C; the second kills, as usual.
volatile std::sig_atomic_t interrupted = 0;

void on_interrupt(int) {
  interrupted = 1;
  std::signal(SIGINT, SIG_DFL);
}

// --method takes the name of a way to solve or of a way to maximise the dual.
void set_method(const std::string& name, Options& options) {
  const core::OptionRow& method = core::find_option("method");
  const core::OptionRow& dual = core::find_option("relaxation.dual_method");
  if (method.read(name, options) || dual.read(name, options)) return;
  throw InputError("method '" + name + "' is not known; there are " + method.rule +
                   ", and for the dual " + dual.rule);
}

Options make_options(const SolveArguments& arguments) {
  Options options = preset(arguments.preset);
  if (!arguments.method.empty()) set_method(arguments.method, options);
  for (const Setting& setting : arguments.settings) {
    core::set_option(setting.name, setting.value, options);
  }
  options.proof = options.proof || !arguments.proof.empty();
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

void print_bound(const Solution& solution) {
  const bool branched = solution.stats.bound_by_branching;
  print("lower bound   %.10g%s\n", solution.lower_bound, branched ? "  (by branching)" : "");
  if (!solution.solutions.empty()) {
    print("gap           %.3g  (%.3g %%)\n", solution.gap(), 100 * solution.relative_gap());
    print("arcs chosen   %zu\n", solution.solutions.front().arcs.size());
  }
  if (branched) {
    print("certificate   %.10g  (by the multipliers alone)\n", solution.stats.certificate_bound);
  }
}

void print_summary(const Solution& solution) {
  print("status        %s\n", to_string(solution.status));
  if (!solution.reason.empty()) print("reason        %s\n", solution.reason.c_str());
  if (!solution.solutions.empty()) {
    print("cost          %.10g%s\n", solution.cost, solution.proven ? "  (proven optimal)" : "");
  }
  if (solution.status != Status::kInfeasible) print_bound(solution);
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

// How many arcs of a solution, best first and lexicographic, another one lacks.
std::size_t num_missing(const RankedSolution& solution, const RankedSolution& other) {
  std::vector<std::vector<Index>> missing;
  std::set_difference(solution.arcs.begin(),
                      solution.arcs.end(),
                      other.arcs.begin(),
                      other.arcs.end(),
                      std::back_inserter(missing));
  return missing.size();
}

void print_ranks(const Solution& solution, RankingMethod method, bool all) {
  const std::vector<RankedSolution>& ranks = solution.solutions;
  if (ranks.empty()) return;
  const bool is_cut_short =
      method == RankingMethod::kExact && solution.proven && num_proven(solution) < ranks.size();
  print("ranks         %zu, %zu of them proven%s\n\n",
        ranks.size(),
        num_proven(solution),
        is_cut_short ? ": a limit stopped ranking" : "");
  print("%10s %18s %14s %8s %8s%s\n",
        "rank",
        "cost",
        "above best",
        "arcs in",
        "arcs out",
        solution.marginals ? "       weight" : "");
  const std::size_t shown = all ? ranks.size() : std::min(ranks.size(), kShownRanks);
  for (const RankedSolution& rank : std::span(ranks).first(shown)) {
    print("%10d %18.6f %14.6g %8zu %8zu",
          rank.rank,
          rank.cost,
          rank.cost - ranks.front().cost,
          num_missing(rank, ranks.front()),
          num_missing(ranks.front(), rank));
    if (solution.marginals)
      print(" %12.6g", solution.marginals->weights[static_cast<std::size_t>(rank.rank) - 1]);
    print("%s\n", rank.proven ? "" : "  (not proven)");
  }
  if (shown < ranks.size()) print("%10s and %zu more\n", "...", ranks.size() - shown);
}

// Of several solutions that were asked for, all must be proven.
int exit_code(const Solution& solution, std::size_t k, RankingMethod method) {
  if (solution.solutions.empty()) return kNoAnswer;
  const std::size_t listed = solution.solutions.size();
  const bool is_short = listed < k && !solution.lists_all;
  if (k > 1 && method == RankingMethod::kExact && (num_proven(solution) < listed || is_short))
    return kStopped;
  const bool answered = solution.status == Status::kOptimal ||
                        solution.status == Status::kGapReached ||
                        solution.status == Status::kPrecisionLost;
  return answered ? kAnswer : kStopped;
}

// What is wrong with the output file is better known before a solve of hours.
void require_good_output(const std::string& output, const std::string& input) {
  if (std::filesystem::is_directory(output))
    throw InputError(output + ": cannot write: Is a directory");
  const std::filesystem::path folder = std::filesystem::path(output).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder)) {
    throw InputError(output + ": cannot write: there is no folder " + folder.string());
  }
  require_other_file(output, input);
}

Solution solve_problem(const Problem& problem,
                       const SolveArguments& arguments,
                       const WarmStart& warm_start,
                       const Options& options) {
  if (!arguments.warm_start.empty()) return solve(problem, options, warm_start);
  return solve_k_best(problem, arguments.k, options);
}

// Why the solve goes without a warm start (docs/hot_starts.md); empty = it does not.
std::string reason_to_start_cold(const Problem& problem, const Options& options) {
  if (problem.is_many_to_one()) return {};
  if (options.proof) return "a proof is asked for";
  if (options.method == Method::kRelaxation) return "relaxation alone starts at multipliers 0";
  if (core::has_forbidden_singleton(problem)) return "a singleton is forbidden";
  return {};
}

void say_if_cold(const Problem& problem, const Options& options, const std::string& file) {
  if (file.empty()) return;
  const std::string reason = reason_to_start_cold(problem, options);
  if (!reason.empty()) std::cerr << "nda: " << file << ": not used, " << reason << '\n';
}

WarmStart read_warm_start(const SolveArguments& arguments) {
  if (arguments.warm_start.empty()) return {};
  if (arguments.k > 1)
    throw InputError("--warm-start is for one solution, --k is " + std::to_string(arguments.k));
  WarmStart warm_start = nda::read_warm_start(arguments.warm_start);
  warm_start.shift(arguments.shift, arguments.keep);
  return warm_start;
}

// An old proof beside a new solution would be taken for its own.
void say_no_proof(const std::string& file) {
  const bool had_one = std::filesystem::is_regular_file(file) && std::filesystem::remove(file);
  std::cerr << "nda: " << file << ": not written, there is no proof"
            << (had_one ? "; the old one is removed\n" : "\n");
}

// Something proved more than the multipliers, and does not write down how (docs/proofs.md).
bool proves_in_silence(const Solution& solution, const Options& options) {
  return solution.stats.bound_by_branching && options.relaxation.kept_sets > 2;
}

void save_proof(const Solution& solution, const Options& options, const std::string& file) {
  if (!solution.proof) return say_no_proof(file);
  write_proof(*solution.proof, file);
  if (proves_in_silence(solution, options)) {
    std::cerr << "nda: " << file
              << ": may show less than the lower bound: relaxations of three sets are not written "
                 "down\n";
  }
}

int solve_file(const SolveArguments& arguments) {
  Options options = make_options(arguments);
  require_good_output(arguments.output, arguments.file);
  require_good_output(arguments.proof, arguments.file);
  if (arguments.proof == "-") throw InputError("--proof needs the name of a file, found '-'");
  require_two_files(arguments.output, arguments.proof);
  require_good_output(arguments.save_warm_start, arguments.file);
  require_two_files(arguments.output, arguments.save_warm_start);
  require_two_files(arguments.proof, arguments.save_warm_start);
  const WarmStart warm_start = read_warm_start(arguments);
  const bool json = arguments.json || arguments.output == "-";
  const core::Stopwatch reading;
  const Problem problem = read_problem(arguments.file);
  const double read_seconds = reading.seconds();
  ProgressLog log(std::cerr, arguments.log_interval_s);
  options.progress = [&](const Progress& progress) {
    if (!arguments.quiet && !json) log(progress);
    return interrupted == 0;
  };
  if (!arguments.proof.empty() && problem.is_many_to_one()) say_no_proof(arguments.proof);
  say_if_cold(problem, options, arguments.warm_start);
  std::signal(SIGINT, on_interrupt);
  Solution solution = solve_problem(problem, arguments, warm_start, options);
  solution.stats.read_seconds = read_seconds;
  const core::Stopwatch weighing;
  if (arguments.marginals) solution.marginals = marginals(solution, {arguments.cost_per_nat});
  const double marginal_seconds = weighing.seconds();
  if (!arguments.output.empty() && arguments.output != "-") {
    write_solution(solution, arguments.output);
  }
  if (!arguments.save_warm_start.empty())
    write_warm_start(nda::warm_start(solution), arguments.save_warm_start);
  if (!arguments.proof.empty()) save_proof(solution, options, arguments.proof);
  if (json) {
    std::cout << solution_to_json(solution);
  } else {
    print_summary(solution);
    if (arguments.k > 1) print_ranks(solution, options.ranking.method, arguments.verbose);
    if (solution.marginals) print_marginals(solution, marginal_seconds, arguments.verbose);
    if (arguments.verbose) {
      print_components(solution);
      print_yields(solution);
    }
  }
  return exit_code(solution, arguments.k, options.ranking.method);
}

// A flag for an option of the table; the flag's help is the row's meaning.
void add_setting(CLI::App& parser,
                 const std::shared_ptr<SolveArguments>& arguments,
                 const char* flag,
                 const char* name) {
  parser
      .add_option_function<std::string>(
          flag,
          [arguments, name](const std::string& value) {
            arguments->settings.push_back({name, value});
          },
          core::find_option(name).meaning)
      ->type_name("NUMBER")
      ->check(as_option(name));
}

Setting split_setting(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    throw CLI::ValidationError("--set", "expected NAME=VALUE, found '" + text + "'");
  }
  const Setting setting = {text.substr(0, equals), text.substr(equals + 1)};
  const std::string fault = as_option(setting.name)(setting.value);
  if (!fault.empty()) throw CLI::ValidationError("--set", fault);
  return setting;
}

void add_settings(CLI::App& parser, const std::shared_ptr<SolveArguments>& arguments) {
  parser.add_option("--preset", arguments->preset, preset_names());
  add_setting(parser, arguments, "--time-limit", "time_limit_s");
  add_setting(parser, arguments, "--gap", "relative_gap");
  add_setting(parser, arguments, "--threads", "num_threads");
  add_setting(parser, arguments, "--seed", "seed");
  parser.add_option("--method",
                    arguments->method,
                    core::find_option("method").rule + "; or how the dual is maximised: " +
                        core::find_option("relaxation.dual_method").rule);
  parser
      .add_option_function<std::vector<std::string>>(
          "--set",
          [arguments](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
              arguments->settings.push_back(split_setting(text));
            }
          },
          "any option of `nda options`, may be given again; overrides all others")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
}

void add_ranking(CLI::App& parser, const std::shared_ptr<SolveArguments>& arguments) {
  CLI::Option* k = parser.add_option("--k", arguments->k, "how many solutions, the best ones");
  k->check(whole_number());
  CLI::Option* marginals = parser.add_flag(
      "--marginals",
      arguments->marginals,
      "how likely each arc, pair and index is over the K best, costs being -log likelihood ratios");
  marginals->needs(k);
  parser
      .add_option(
          "--cost-per-nat",
          arguments->cost_per_nat,
          "the cost that makes a solution e times less likely (1); 2 for -2 log likelihoods")
      ->check(above(0))
      ->needs(marginals);
}

void add_warm_start(CLI::App& parser, const std::shared_ptr<SolveArguments>& arguments) {
  CLI::Option* file =
      parser.add_option("--warm-start",
                        arguments->warm_start,
                        "start from what --save-warm-start wrote, as of the window before (not "
                        "with --k above 1)");
  file->check(file_name());
  CLI::Option* shift =
      parser.add_option("--shift",
                        arguments->shift,
                        "the window dropped so many dimensions since, and gained as many at its "
                        "end");
  shift->check(whole_number(0, kDimensionBits))->needs(file);
  parser
      .add_option("--keep",
                  arguments->keep,
                  "but kept so many at its front, as a list of tracks (with --shift)")
      ->check(whole_number(0, kDimensionBits))
      ->needs(shift);
  parser
      .add_option("--save-warm-start",
                  arguments->save_warm_start,
                  "write multipliers and arcs of the best solution for a later --warm-start")
      ->check(file_name());
}

}  // namespace

Action declare_solve(CLI::App& parser) {
  const auto arguments = std::make_shared<SolveArguments>();
  parser.add_option("file", arguments->file, "arc file, '-' for standard input")->required();
  add_ranking(parser, arguments);
  add_settings(parser, arguments);
  add_warm_start(parser, arguments);
  parser
      .add_option(
          "--output,-o", arguments->output, "write the solution as JSON; '-' is the same as --json")
      ->check(file_name());
  parser
      .add_option(
          "--proof",
          arguments->proof,
          "write why the bound holds, for nda check --proof; compressed where the name ends in "
          ".gz")
      ->check(file_name());
  parser.add_flag("--json", arguments->json, "print the JSON alone");
  parser
      .add_option("--log-interval", arguments->log_interval_s, "seconds between lines of the log")
      ->check(at_least(0));
  parser.add_flag("--quiet,-q", arguments->quiet, "no solver log");
  parser.add_flag("--verbose,-v",
                  arguments->verbose,
                  "one line per component, and what reductions and fixing did");
  parser.footer(
      "The log on standard error shows time, cost of the best assignment, lower bound and gap;\n"
      "what the multipliers prove of the bound, its certificate, is verified by `nda check`; the\n"
      "rest rests on branching.  Ctrl-C stops with the best so far.  Exit codes: 0 answer, 1 no\n"
      "answer, 2 bad input, 3 stopped by a limit.\n"
      "\n"
      "Example:\n"
      "  nda solve window.nda.gz --time-limit 10 --output window.json\n"
      "  nda check window.nda.gz window.json\n"
      "  nda solve window.nda.gz --k 10 --marginals\n"
      "  nda solve first.nda --save-warm-start first.warm\n"
      "  nda solve second.nda --warm-start first.warm --shift 1");
  return [arguments] { return solve_file(*arguments); };
}

}  // namespace nda::cli
