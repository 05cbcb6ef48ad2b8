#include "lp/linear_program.hpp"

#include <algorithm>
#include <coin/ClpSimplex.hpp>

// CLP copies all of a matrix whenever columns are added, so these are collected and handed over
// together.  It has no callback as cheap as a look at the clock: its own limit of seconds serves.

namespace nda::lp {
namespace {

constexpr double kNoLimit = 1e50;
constexpr double kTolerance = 1e-9;
constexpr double kLongest_s = 1e9;
constexpr int kNoIterationLimit = 1 << 30;
constexpr int kKeepFactors = 3;
constexpr int kStatusOptimal = 0;
constexpr int kStatusInfeasible = 1;
constexpr int kStatusStopped = 3;

}  // namespace

struct LinearProgram::Clp {
  ClpSimplex simplex;
  std::vector<double> cost;  // of the columns to be handed over
  std::vector<double> upper;
  std::vector<CoinBigIndex> start = {0};
  std::vector<int> rows;
  std::vector<double> values;
};

LinearProgram::LinearProgram() : clp_(std::make_unique<Clp>()) {
  clp_->simplex.setLogLevel(0);
  clp_->simplex.setDualTolerance(kTolerance);
  clp_->simplex.setPrimalTolerance(kTolerance);
  clp_->simplex.resize(0, 0);
}

LinearProgram::~LinearProgram() = default;

void LinearProgram::add_empty_rows(int count) {
  hand_over();
  const std::vector<double> lower(static_cast<std::size_t>(count), -COIN_DBL_MAX);
  const std::vector<double> upper(static_cast<std::size_t>(count), 1.0);
  const std::vector<CoinBigIndex> start(static_cast<std::size_t>(count) + 1, 0);
  clp_->simplex.addRows(count, lower.data(), upper.data(), start.data(), nullptr, nullptr);
}

void LinearProgram::add_row(SparseView row, double right_side) {
  hand_over();
  const double lower = -COIN_DBL_MAX;
  const CoinBigIndex start[] = {0, static_cast<CoinBigIndex>(row.index.size())};
  clp_->simplex.addRows(1, &lower, &right_side, start, row.index.data(), row.value.data());
}

void LinearProgram::add_column(SparseView column, double cost, double upper) {
  clp_->cost.push_back(cost);
  clp_->upper.push_back(upper);
  clp_->rows.insert(clp_->rows.end(), column.index.begin(), column.index.end());
  clp_->values.insert(clp_->values.end(), column.value.begin(), column.value.end());
  clp_->start.push_back(static_cast<CoinBigIndex>(clp_->rows.size()));
}

void LinearProgram::hand_over() {
  if (clp_->cost.empty()) return;
  const std::vector<double> lower(clp_->cost.size(), 0.0);
  clp_->simplex.addColumns(static_cast<int>(clp_->cost.size()),
                           lower.data(),
                           clp_->upper.data(),
                           clp_->cost.data(),
                           clp_->start.data(),
                           clp_->rows.data(),
                           clp_->values.data());
  clp_->cost.clear();
  clp_->upper.clear();
  clp_->start.assign(1, 0);
  clp_->rows.clear();
  clp_->values.clear();
}

void LinearProgram::remove_rows(std::span<const int> rows) {
  if (rows.empty()) return;
  hand_over();
  clp_->simplex.deleteRows(static_cast<int>(rows.size()), rows.data());
}

void LinearProgram::remove_columns(std::span<const int> columns) {
  if (columns.empty()) return;
  hand_over();
  clp_->simplex.deleteColumns(static_cast<int>(columns.size()), columns.data());
}

void LinearProgram::set_upper(int column, double upper) {
  hand_over();
  clp_->simplex.setColumnUpper(column, upper);
}

void LinearProgram::set_equality(int row, bool equality) {
  ClpSimplex& simplex = clp_->simplex;
  simplex.setRowLower(row, equality ? simplex.rowUpper()[row] : -COIN_DBL_MAX);
}

int LinearProgram::num_rows() const {
  return clp_->simplex.numberRows();
}

int LinearProgram::num_columns() const {
  return clp_->simplex.numberColumns() + static_cast<int>(clp_->cost.size());
}

Outcome LinearProgram::solve_primal(const core::Deadline& deadline) {
  hand_over();
  return run(deadline, kNoLimit, kNoIterationLimit, [](ClpSimplex& simplex) {
    simplex.primal(0, kKeepFactors);
  });
}

Outcome LinearProgram::solve_dual(const core::Deadline& deadline,
                                  double objective_limit,
                                  int max_iterations) {
  hand_over();
  return run(deadline, objective_limit, max_iterations, [](ClpSimplex& simplex) {
    simplex.dual(0, kKeepFactors);
  });
}

// Where the basis led into trouble, the one of slacks leads out of it.
template <typename Algorithm>
Outcome LinearProgram::run(const core::Deadline& deadline,
                           double objective_limit,
                           int max_iterations,
                           Algorithm algorithm) {
  ClpSimplex& simplex = clp_->simplex;
  for (const bool again : {false, true}) {
    if (again) simplex.allSlackBasis(true);
    simplex.setMaximumSeconds(std::clamp(deadline.remaining_s(), 1e-3, kLongest_s));
    simplex.setDualObjectiveLimit(std::min(objective_limit, kNoLimit));
    simplex.setMaximumIterations(max_iterations);
    if (again)
      simplex.primal();
    else
      algorithm(simplex);
    iterations_ += simplex.numberIterations();
    if (simplex.status() == kStatusOptimal) {
      return simplex.objectiveValue() >= objective_limit ? Outcome::kCutoff : Outcome::kOptimal;
    }
    if (simplex.status() == kStatusStopped) return Outcome::kStopped;
    if (simplex.status() == kStatusInfeasible && objective_limit < kNoLimit)
      return Outcome::kCutoff;
  }
  return Outcome::kFailed;
}

double LinearProgram::objective() const {
  return clp_->simplex.objectiveValue();
}

std::span<const double> LinearProgram::primal() const {
  return {clp_->simplex.primalColumnSolution(),
          static_cast<std::size_t>(clp_->simplex.numberColumns())};
}

std::span<const double> LinearProgram::dual() const {
  return {clp_->simplex.dualRowSolution(), static_cast<std::size_t>(clp_->simplex.numberRows())};
}

std::vector<unsigned char> LinearProgram::basis() const {
  const ClpSimplex& simplex = clp_->simplex;
  const unsigned char* status = simplex.statusArray();
  return {status, status + simplex.numberRows() + simplex.numberColumns()};
}

void LinearProgram::set_basis(const std::vector<unsigned char>& basis) {
  clp_->simplex.copyinStatus(basis.data());
}

}  // namespace nda::lp
