#pragma once

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "nda/assign2d.hpp"

namespace nda::support {

/// The largest finite cost in magnitude.
inline double cost_scale(const Assign2dProblem& problem) {
  double scale = 0;
  for (const auto& costs : {problem.cost, problem.row_outside, problem.column_outside}) {
    for (const double x : costs) {
      if (std::isfinite(x)) scale = std::max(scale, std::abs(x));
    }
  }
  return scale;
}

/// Checks a result against its contract, sharing nothing with the solvers.  One sentence per fault.
class Certificate {
 public:
  /// @param is_optimal  whether the duals are to prove it.
  Certificate(const Assign2dProblem& problem, const Assign2dResult& result, bool is_optimal = true)
      : problem_(problem), result_(result), tolerance_(1e-12 * cost_scale(problem)) {
    if (result.feasible) {
      check_mates();
      if (faults_.empty() && is_optimal) check_duals();
    } else {
      check_hall();
    }
  }

  const std::vector<std::string>& faults() const { return faults_; }

 private:
  template <class... Parts>
  void expect(bool holds, const Parts&... parts) {
    if (holds) return;
    std::ostringstream text;
    text.precision(17);
    (text << ... << parts);
    faults_.push_back(text.str());
  }

  // Cost of the stored pair, +inf if there is none.
  double pair_cost(std::uint32_t i, std::int32_t j) const {
    for (std::uint32_t k = problem_.row_start[i]; k < problem_.row_start[i + 1]; ++k) {
      if (static_cast<std::int32_t>(problem_.column[k]) == j) return problem_.cost[k];
    }
    return kInfinity;
  }

  void check_mates() {
    expect(result_.column_of_row.size() == problem_.num_rows(), "size of column_of_row");
    expect(result_.row_of_column.size() == problem_.num_columns(), "size of row_of_column");
    expect(result_.u.size() == problem_.num_rows(), "size of u");
    expect(result_.v.size() == problem_.num_columns(), "size of v");
    expect(result_.hall_rows.empty() && result_.hall_columns.empty(), "feasible with a Hall set");
    if (!faults_.empty()) return;
    double cost = 0;
    std::uint32_t num_pairs = 0;
    for (std::uint32_t i = 0; i < problem_.num_rows(); ++i) {
      const std::int32_t j = result_.column_of_row[i];
      if (j == kUnassigned) {
        cost += problem_.row_outside[i];
        continue;
      }
      ++num_pairs;
      cost += pair_cost(i, j);
      expect(result_.row_of_column.at(j) == static_cast<std::int32_t>(i), "mates of row ", i);
    }
    for (std::uint32_t j = 0; j < problem_.num_columns(); ++j) {
      if (result_.row_of_column[j] == kUnassigned) cost += problem_.column_outside[j];
      if (result_.row_of_column[j] != kUnassigned) --num_pairs;
    }
    expect(num_pairs == 0, "rows and columns disagree on the number of pairs");
    const double members = problem_.num_rows() + problem_.num_columns();
    expect(cost == result_.cost || std::abs(cost - result_.cost) <= members * tolerance_,
           "cost ",
           result_.cost,
           " is stated, ",
           cost,
           " is right");
  }

  void check_duals() {
    double sum = 0;
    for (std::uint32_t i = 0; i < problem_.num_rows(); ++i) {
      check_dual("u", i, result_.u[i], problem_.row_outside[i], result_.column_of_row[i]);
      sum += result_.u[i];
      for (std::uint32_t k = problem_.row_start[i]; k < problem_.row_start[i + 1]; ++k) {
        const std::uint32_t j = problem_.column[k];
        const double reduced = problem_.cost[k] - result_.u[i] - result_.v[j];
        expect(reduced >= -tolerance_, "pair ", i, ",", j, " has reduced cost ", reduced);
        if (result_.column_of_row[i] == static_cast<std::int32_t>(j)) {
          expect(reduced <= tolerance_, "chosen pair ", i, ",", j, " has reduced cost ", reduced);
        }
      }
    }
    for (std::uint32_t j = 0; j < problem_.num_columns(); ++j) {
      check_dual("v", j, result_.v[j], problem_.column_outside[j], result_.row_of_column[j]);
      sum += result_.v[j];
    }
    const double members = problem_.num_rows() + problem_.num_columns();
    expect(std::abs(sum - result_.cost) <= members * tolerance_,
           "duals sum up to ",
           sum,
           ", cost is ",
           result_.cost);
  }

  void check_dual(
      const char* name, std::uint32_t at, double dual, double outside, std::int32_t mate) {
    expect(std::isfinite(dual), name, "[", at, "] is ", dual);
    expect(dual <= outside + tolerance_, name, "[", at, "] = ", dual, " exceeds ", outside);
    if (mate == kUnassigned) {
      expect(dual >= outside - tolerance_,
             "unassigned ",
             name,
             "[",
             at,
             "] = ",
             dual,
             " is below ",
             outside);
    }
  }

  void check_hall() {
    expect(result_.cost == kInfinity, "infeasible, but cost ", result_.cost);
    const std::set<std::uint32_t> rows(result_.hall_rows.begin(), result_.hall_rows.end());
    const std::set<std::uint32_t> columns(result_.hall_columns.begin(), result_.hall_columns.end());
    std::set<std::uint32_t> partners_of_rows, partners_of_columns;
    for (std::uint32_t i = 0; i < problem_.num_rows(); ++i) {
      for (std::uint32_t k = problem_.row_start[i]; k < problem_.row_start[i + 1]; ++k) {
        if (problem_.cost[k] == kInfinity) continue;
        if (rows.count(i) > 0) partners_of_rows.insert(problem_.column[k]);
        if (columns.count(problem_.column[k]) > 0) partners_of_columns.insert(i);
      }
    }
    for (const std::uint32_t i : rows) {
      expect(problem_.row_outside[i] == kInfinity, "Hall row ", i, " need not be assigned");
    }
    for (const std::uint32_t j : columns) {
      expect(problem_.column_outside[j] == kInfinity, "Hall column ", j, " need not be assigned");
    }
    expect(rows.size() > partners_of_rows.size() || columns.size() > partners_of_columns.size(),
           "no Hall set: ",
           rows.size(),
           " rows have ",
           partners_of_rows.size(),
           " partners, ",
           columns.size(),
           " columns ",
           partners_of_columns.size());
  }

  const Assign2dProblem& problem_;
  const Assign2dResult& result_;
  double tolerance_;
  std::vector<std::string> faults_;
};

inline std::vector<std::string> faults_of(const Assign2dProblem& problem,
                                          const Assign2dResult& result) {
  return Certificate(problem, result).faults();
}

/// Without what is about optimality: mates, cost.
inline std::vector<std::string> faults_of_assignment(const Assign2dProblem& problem,
                                                     const Assign2dResult& result) {
  return Certificate(problem, result, false).faults();
}

}  // namespace nda::support
