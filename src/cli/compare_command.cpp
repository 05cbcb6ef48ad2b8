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
#include "nda/io.hpp"

namespace nda::cli {
namespace {

struct CompareArguments {
  std::vector<std::string> files;
  std::vector<std::string> methods;
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

int compare_files(const CompareArguments& arguments) {
  const InterruptWatch interrupt;
  std::vector<Problem> problems;
  for (const std::string& file : arguments.files) {
    require_other_file(arguments.csv, file);
    problems.push_back(read_problem(file));
  }
  const mip::MethodChoice choice = mip::choose_methods(arguments.methods, surroundings());
  CsvFile csv(arguments.csv);
  const mip::RunLimits limits = {arguments.time_limit_s, interrupt.token()};
  std::vector<mip::FileComparison> comparisons;
  bool consistent = true;
  for (std::size_t f = 0; f < problems.size() && !limits.stop.stop_requested(); ++f) {
    const std::string& file = arguments.files[f];
    comparisons.push_back(
        mip::run_methods(file, problems[f], choice.methods, limits, progress_of(file)));
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
         "and the groups nda, baseline, external; all by default.  cbc, glpk (glpsol), scipy and\n"
         "highs are run as child processes where they are installed.  All use one thread and a\n"
         "relative gap of 0; their solutions are verified before they enter the table.  '*' marks\n"
         "the best cost and the best bound; docs/compare.md explains every column.\n"
         "Exit codes: 0 all claims agree, 1 two methods contradict each other (a line names "
         "both),\n"
         "2 bad input, 3 interrupted.\n"
         "\n"
         "Example:\n"
         "  nda compare window.nda.gz --methods default,sgts,cbc --time-limit 20 --csv table.csv";
}

}  // namespace

Action declare_compare(CLI::App& parser) {
  const auto arguments = std::make_shared<CompareArguments>();
  parser.add_option("file", arguments->files, "problems to solve, '-' for standard input")
      ->required();
  parser.add_option("--methods", arguments->methods, "names separated by commas, see below")
      ->delimiter(',')
      ->allow_extra_args(false);
  parser.add_option("--time-limit", arguments->time_limit_s, "seconds per method and file")
      ->check(as_option("time_limit_s"))
      ->capture_default_str();
  parser.add_option("--csv", arguments->csv, "write all figures to this file as well")
      ->check(file_name());
  parser.footer(footer());
  return [arguments] { return compare_files(*arguments); };
}

}  // namespace nda::cli
