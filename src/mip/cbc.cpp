#include <cmath>
#include <string>

#include "mip/external_solver.hpp"
#include "mip/solver_text.hpp"

// CBC (Forrest et al., COIN-OR).  Its gaps are 0 by default but for an `increment`: solutions that
// are better by less are thrown away.  1e-5 is too coarse for problems with costs of about 1; where
// all costs share a step CBC raises it by itself.  The time limit counts CPU seconds unless told
// otherwise.
//
// Solution file: "Optimal - objective value -308.00460000" (or "Stopped on time - ...", "Infeasible
// - ...", "Integer infeasible - ...", with "(no integer solution - continuous used)" where there is
// none), then one line per column that is not 0: number, name, value, cost; preceded by "**" where
// it breaks a bound.  The bound stands in the log: "Lower bound:   -208.534".

namespace nda::mip {
namespace {

ExternalStatus status_of(const std::string& headline) {
  const auto starts = [&](const char* text) { return headline.rfind(text, 0) == 0; };
  if (starts("Optimal")) return ExternalStatus::kOptimal;
  if (starts("Stopped on time")) return ExternalStatus::kTimeLimit;
  if (starts("Infeasible") || starts("Integer infeasible")) return ExternalStatus::kInfeasible;
  return ExternalStatus::kFailed;
}

class Cbc : public ExternalSolver {
 public:
  Cbc(std::string program, const Surroundings& surroundings)
      : ExternalSolver(surroundings.temporary_folder), program_(std::move(program)) {}

 private:
  std::vector<std::string> command(double time_limit_s) const override {
    std::vector<std::string> words = {program_, kModelFile, "-timeMode", "elapsed"};
    if (time_limit_s < kInfinity) {
      words.insert(words.end(), {"-seconds", std::to_string(time_limit_s)});
    }
    words.insert(words.end(), {"-ratioGap", "0", "-allowableGap", "0", "-increment", "1e-9"});
    words.insert(words.end(), {"-threads", "0", "-solve", "-solution", kSolutionFile});
    return words;
  }

  RawAnswer read_answer(const std::string& folder) const override {
    RawAnswer raw;
    const std::vector<std::string> lines = read_lines(folder + "/" + kSolutionFile);
    if (lines.empty()) return raw;
    raw.status = status_of(lines.front());
    const std::vector<std::string> objective = words_after_last({lines.front()}, "value");
    if (!objective.empty()) raw.objective = number_in(objective.front()).value_or(kInfinity);
    raw.has_solution = raw.status == ExternalStatus::kOptimal ||
                       (raw.status == ExternalStatus::kTimeLimit &&
                        lines.front().find("no integer solution") == std::string::npos);
    if (raw.has_solution) read_columns(lines, raw);
    const auto bound = words_after_last(read_lines(folder + "/" + kLogFile), "Lower bound:");
    if (!bound.empty()) raw.bound = lowered_number_in(bound.front()).value_or(-kInfinity);
    return raw;
  }

  static void read_columns(const std::vector<std::string>& lines, RawAnswer& raw) {
    for (std::size_t l = 1; l < lines.size(); ++l) {
      std::vector<std::string> words = words_of(lines[l]);
      if (!words.empty() && words.front() == "**") words.erase(words.begin());
      const auto column = words.size() == 4 ? count_in(words[0]) : std::nullopt;
      const auto value = words.size() == 4 ? number_in(words[2]) : std::nullopt;
      if (!column || !value) {
        raw = {};
        return;
      }
      raw.take(*column, *value);
    }
  }

  std::string program_;
};

}  // namespace

std::unique_ptr<ExternalSolver> find_cbc(const Surroundings& surroundings) {
  const auto program = find_program("cbc", surroundings.search_path);
  if (!program) return nullptr;
  return std::make_unique<Cbc>(*program, surroundings);
}

}  // namespace nda::mip
