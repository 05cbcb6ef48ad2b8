#include <fstream>
#include <string>

#include "mip/external_solver.hpp"
#include "mip/solver_text.hpp"

// HiGHS (Huangfu & Hall) as its own program, which Debian 12 does not have.
//
// Solution file: a line "Model status" followed by the status, "# Primal solution values" followed
// by "Feasible" where there is a solution, "Objective X", "# Columns N" and N lines "name value".
// The bound stands in the log: "  Dual bound        -308.0046".

namespace nda::mip {
namespace {

constexpr const char* kOptionsFile = "options";

ExternalStatus status_of(const std::string& line) {
  if (line == "Optimal") return ExternalStatus::kOptimal;
  if (line == "Time limit reached") return ExternalStatus::kTimeLimit;
  if (line == "Infeasible") return ExternalStatus::kInfeasible;
  return ExternalStatus::kFailed;
}

class Highs : public ExternalSolver {
 public:
  Highs(std::string program, const Surroundings& surroundings)
      : ExternalSolver(surroundings.temporary_folder), program_(std::move(program)) {}

 private:
  void write_model(const Problem& problem, const std::string& folder) const override {
    ExternalSolver::write_model(problem, folder);
    std::ofstream(folder + "/" + kOptionsFile)
        << "mip_rel_gap = 0\nmip_abs_gap = 1e-9\nthreads = 1\nparallel = off\n";
  }

  std::vector<std::string> command(double time_limit_s) const override {
    std::vector<std::string> words = {program_, "--options_file", kOptionsFile};
    if (time_limit_s < kInfinity) {
      words.insert(words.end(), {"--time_limit", std::to_string(time_limit_s)});
    }
    words.insert(words.end(), {"--solution_file", kSolutionFile, kModelFile});
    return words;
  }

  RawAnswer read_answer(const std::string& folder) const override {
    RawAnswer raw;
    const std::vector<std::string> lines = read_lines(folder + "/" + kSolutionFile);
    for (std::size_t l = 0; l + 1 < lines.size(); ++l) {
      if (lines[l] == "Model status") raw.status = status_of(lines[l + 1]);
      if (lines[l] == "# Primal solution values") {
        raw.has_solution = lines[l + 1] == "Feasible";
        if (raw.has_solution) read_columns(lines, l + 2, raw);
        break;
      }
    }
    const auto bound = words_after_last(read_lines(folder + "/" + kLogFile), "Dual bound");
    if (!bound.empty()) raw.bound = number_in(bound.front()).value_or(-kInfinity);
    return raw;
  }

  // From the line "Objective X" on.
  static void read_columns(const std::vector<std::string>& lines, std::size_t l, RawAnswer& raw) {
    std::size_t column = 0;
    bool in_columns = false;
    for (; l < lines.size(); ++l) {
      const std::vector<std::string> words = words_of(lines[l]);
      if (words.size() == 2 && words[0] == "Objective") {
        raw.objective = number_in(words[1]).value_or(kInfinity);
      } else if (words.size() == 3 && words[0] == "#") {
        if (in_columns) return;
        in_columns = words[1] == "Columns";
      } else if (in_columns && words.size() == 2) {
        raw.take(column++, number_in(words[1]).value_or(0.5));
      }
    }
  }

  std::string program_;
};

}  // namespace

std::unique_ptr<ExternalSolver> find_highs(const Surroundings& surroundings) {
  const auto program = find_program("highs", surroundings.search_path);
  if (!program) return nullptr;
  return std::make_unique<Highs>(*program, surroundings);
}

}  // namespace nda::mip
