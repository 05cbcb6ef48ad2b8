#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "mip/external_solver.hpp"
#include "mip/solver_text.hpp"

// GLPK's glpsol with its default branching and no cuts.  The time limit is in whole seconds.
//
// Solution file, "s mip ROWS COLUMNS STATUS OBJECTIVE" with status o (optimal), f (feasible),
// n (none exists), u (unknown), then "j COLUMN VALUE" counted from 1.  Where already the linear
// relaxation is infeasible the status is u and the log says so.  The bound stands in the lines of
// progress: "+ 360: mip = -2.041410000e+02 >= -2.074433451e+02 1.6% (18; 5)".

namespace nda::mip {
namespace {

double last_bound(const std::vector<std::string>& log) {
  const std::vector<std::string> words = words_after_last(log, ">= ");
  return words.empty() ? -kInfinity : lowered_number_in(words.front()).value_or(-kInfinity);
}

bool says(const std::vector<std::string>& log, const char* text) {
  return std::any_of(log.begin(), log.end(), [&](const std::string& line) {
    return line.find(text) != std::string::npos;
  });
}

class Glpk : public ExternalSolver {
 public:
  Glpk(std::string program, const Surroundings& surroundings)
      : ExternalSolver(surroundings.temporary_folder), program_(std::move(program)) {}

 private:
  std::vector<std::string> command(double time_limit_s) const override {
    std::vector<std::string> words = {program_, "--freemps", kModelFile, "--mipgap", "0"};
    if (time_limit_s < std::numeric_limits<int>::max() / 1000) {
      words.insert(words.end(),
                   {"--tmlim", std::to_string(static_cast<int>(std::ceil(time_limit_s)))});
    }
    words.insert(words.end(), {"--write", kSolutionFile});
    return words;
  }

  RawAnswer read_answer(const std::string& folder) const override {
    RawAnswer raw;
    const std::vector<std::string> log = read_lines(folder + "/" + kLogFile);
    raw.bound = last_bound(log);
    for (const std::string& line : read_lines(folder + "/" + kSolutionFile)) {
      const std::vector<std::string> words = words_of(line);
      if (words.size() == 6 && words[0] == "s" && words[1] == "mip") {
        read_status(words[4], log, raw);
        raw.objective = number_in(words[5]).value_or(kInfinity);
      } else if (words.size() == 3 && words[0] == "j") {
        const auto column = count_in(words[1]);
        if (column && *column > 0) raw.take(*column - 1, number_in(words[2]).value_or(0.5));
      }
    }
    if (raw.status == ExternalStatus::kOptimal) raw.bound = -kInfinity;
    return raw;
  }

  static void read_status(const std::string& word,
                          const std::vector<std::string>& log,
                          RawAnswer& raw) {
    raw.has_solution = word == "o" || word == "f";
    const bool none_exists = word == "n" || says(log, "HAS NO PRIMAL FEASIBLE SOLUTION") ||
                             says(log, "HAS NO INTEGER FEASIBLE SOLUTION");
    if (word == "o") {
      raw.status = ExternalStatus::kOptimal;
    } else if (says(log, "TIME LIMIT EXCEEDED")) {
      raw.status = ExternalStatus::kTimeLimit;
    } else if (none_exists) {
      raw.status = ExternalStatus::kInfeasible;
    }
  }

  std::string program_;
};

}  // namespace

std::unique_ptr<ExternalSolver> find_glpk(const Surroundings& surroundings) {
  const auto program = find_program("glpsol", surroundings.search_path);
  if (!program) return nullptr;
  return std::make_unique<Glpk>(*program, surroundings);
}

}  // namespace nda::mip
