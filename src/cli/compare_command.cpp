#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "mip/comparison.hpp"
#include "mip/comparison_text.hpp"
#include "mip/methods.hpp"
#include "nda/generate.hpp"
#include "nda/io.hpp"

namespace nda::cli {
namespace {

struct CompareArguments {
  std::vector<std::string> files;
  std::vector<std::string> methods;
  bool presets = false;
  double time_limit_s = 10;
  std::string csv;
};

// Turns the first SIGINT, SIGTERM or SIGHUP into a stop request, so that children are ended and
// temporary files removed; the second one kills.  To be made before any other thread, which
// inherits that the signals are blocked.
class InterruptWatch {
 public:
  InterruptWatch() {
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals_, signal);
    pthread_sigmask(SIG_BLOCK, &signals_, &before_);
    thread_ = std::jthread([this](const std::stop_token& ended) { watch(ended); });
  }
  ~InterruptWatch() {
    thread_.request_stop();
    thread_.join();
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  void watch(const std::stop_token& ended) {
    const timespec interval = {0, 20'000'000};
    while (!ended.stop_requested()) {
      if (sigtimedwait(&signals_, nullptr, &interval) < 0) continue;
      source_.request_stop();
      pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
      return;
    }
  }

  sigset_t signals_;
  sigset_t before_;
  std::stop_source source_;
  std::jthread thread_;
};

mip::Surroundings surroundings() {
  mip::Surroundings result;
  const char* path = std::getenv("PATH");
  if (path != nullptr) result.search_path = path;
  result.temporary_folder = std::filesystem::temp_directory_path().string();
  return result;
}

// Writes the rows of each file as soon as they are known: a long run that dies leaves what it has.
class CsvFile {
 public:
  explicit CsvFile(const std::string& path) : path_(path) {
    if (path.empty()) return;
    file_.open(path);
    write(mip::csv_header());
  }

  void write(const std::string& rows) {
    if (path_.empty()) return;
    if (!(file_ << rows << std::flush)) throw InputError(path_ + ": cannot be written");
  }

 private:
  std::string path_;
  std::ofstream file_;
};

mip::Watcher progress_of(const std::string& file) {
  mip::Watcher watcher;
  watcher.before = [file](const mip::Contender& method) {
    std::cerr << file << ": " << method.name << " ..." << std::flush;
  };
  watcher.after = [](const mip::MethodResult& result) {
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%.4f", result.seconds);
    std::cerr << ' ' << result.status << ", " << seconds << " s\n";
  };
  return watcher;
}

// Sentences under a table; true when there are none that accuse somebody.
bool print_remarks(const std::vector<std::string>& missing,
                   const std::vector<std::string>& accusations) {
  for (const std::string& sentence : missing) std::cout << sentence << '\n';
  for (const std::string& sentence : accusations) std::cout << "INCONSISTENT: " << sentence << '\n';
  std::cout << '\n' << std::flush;
  return accusations.empty();
}

struct NamedProblem {
  std::string name;
  Problem problem;
};

// A small problem of each benchmark family.
std::vector<NamedProblem> families() {
  PooreSparseOptions sparse;
  sparse.arcs = 2000;
  std::vector<NamedProblem> problems;
  problems.push_back({"poore-5.1", generate_poore_sparse(sparse).problem});
  problems.push_back({"poore-5.3", generate_poore_dense().problem});
  problems.push_back({"map3", generate_map3().problem});
  problems.push_back({"gadgets", generate_gadgets().problem});
  problems.push_back({"planted", generate_planted().problem});
  for (const char* name : {"small", "hard6", "six-scan"})
    problems.push_back({name, generate_tracking(tracking_preset(name)).problem});
  return problems;
}

std::vector<NamedProblem> collect(const CompareArguments& arguments) {
  if (arguments.files.empty()) {
    if (arguments.presets) return families();
    throw InputError("no file given (only --presets can do without)");
  }
  std::vector<NamedProblem> problems;
  for (const std::string& file : arguments.files) {
    require_other_file(arguments.csv, file);
    problems.push_back({file, read_problem(file)});
  }
  return problems;
}

int compare_files(const CompareArguments& arguments) {
  const InterruptWatch interrupt;
  const std::vector<NamedProblem> problems = collect(arguments);
  std::vector<std::string> methods = arguments.methods;
  if (arguments.presets) methods.insert(methods.end(), {"default", "paper"});
  const mip::MethodChoice choice = mip::choose_methods(methods, surroundings());
  CsvFile csv(arguments.csv);
  const mip::RunLimits limits = {arguments.time_limit_s, interrupt.token()};
  std::vector<mip::FileComparison> comparisons;
  bool consistent = true;
  for (std::size_t f = 0; f < problems.size() && !limits.stop.stop_requested(); ++f) {
    const std::string& file = problems[f].name;
    comparisons.push_back(
        mip::run_methods(file, problems[f].problem, choice.methods, limits, progress_of(file)));
    std::cout << mip::comparison_table(comparisons.back());
    consistent =
        print_remarks(choice.missing, mip::contradictions(comparisons.back())) && consistent;
    csv.write(mip::csv_rows(comparisons.back(), arguments.time_limit_s));
  }
  if (comparisons.size() > 1) std::cout << mip::summary_table(comparisons);
  if (!consistent) return kNoAnswer;
  return limits.stop.stop_requested() ? kStopped : kAnswer;
}

std::string footer() {
  std::string names;
  for (const std::string& name : mip::method_names()) names += " " + name;
  return "Methods:" + names +
         "\n"
         "and the groups nda, paper, baseline, external; all but paper by default.  cbc, glpk "
         "(glpsol), scipy and\n"
         "highs are run as child processes where they are installed.  All use one thread and a\n"
         "relative gap of 0; their solutions are verified before they enter the table.  '*' marks\n"
         "the best cost and the best bound; docs/compare.md explains every column.\n"
         "Exit codes: 0 all claims agree, 1 two methods contradict each other (a line names "
         "both),\n"
         "2 bad input, 3 interrupted.\n"
         "\n"
         "Example:\n"
         "  nda compare window.nda.gz --methods default,sgts,cbc --time-limit 20 --csv table.csv\n"
         "  nda compare --presets";
}

}  // namespace

Action declare_compare(CLI::App& parser) {
  const auto arguments = std::make_shared<CompareArguments>();
  parser.add_option("file", arguments->files, "problems to solve, '-' for standard input");
  parser.add_option("--methods", arguments->methods, "names separated by commas, see below")
      ->delimiter(',')
      ->allow_extra_args(false);
  parser.add_flag("--presets",
                  arguments->presets,
                  "the algorithms of papers and the default; without files on a small problem of "
                  "each family");
  parser.add_option("--time-limit", arguments->time_limit_s, "seconds per method and file")
      ->check(as_option("time_limit_s"))
      ->capture_default_str();
  parser.add_option("--csv", arguments->csv, "write all figures to this file as well")
      ->check(file_name());
  parser.footer(footer());
  return [arguments] { return compare_files(*arguments); };
}

}  // namespace nda::cli
