#include "lp/linear_program.hpp"

#include <algorithm>
#include <coin/ClpEventHandler.hpp>
#include <coin/ClpSimplex.hpp>

// CLP copies all of a matrix whenever rows or columns are added, so these are collected and handed
// over together.  Its own limit of seconds is looked at between factorizations only, some
// milliseconds apart: an event after every pivot looks as well.

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
constexpr int kStatusStoppedByEvent = 5;
constexpr int kPivotsBetweenLooks = 16;
constexpr int kMostScaledRows = 4000;
constexpr int kNoScaling = 0;
constexpr int kAutomaticScaling = 3;

// Stops the simplex method at the deadline of the run.
class DeadlineEvent : public ClpEventHandler {
 public:
  explicit DeadlineEvent(const core::Deadline* const* deadline) : deadline_(deadline) {}

  int event(Event event) override {
    constexpr int kGoOn = -1;
    if (event != endOfIteration || ++pivots_ % kPivotsBetweenLooks != 0) return kGoOn;
    return *deadline_ != nullptr && (*deadline_)->reached() ? kStatusStoppedByEvent : kGoOn;
  }
  ClpEventHandler* clone() const override { return new DeadlineEvent(*this); }

 private:
  const core::Deadline* const* deadline_;
  int pivots_ = 0;
};

// Rows or columns that CLP does not know yet.
struct Collected {
  std::vector<CoinBigIndex> start = {0};
  std::vector<int> index;
  std::vector<double> value;

  int size() const { return static_cast<int>(start.size()) - 1; }
  void add(SparseView vector) {
    index.insert(index.end(), vector.index.begin(), vector.index.end());
    value.insert(value.end(), vector.value.begin(), vector.value.end());
    start.push_back(static_cast<CoinBigIndex>(index.size()));
  }
};

}  // namespace

struct LinearProgram::Clp {
  Clp() = default;
  // The model and its basis.  ClpSimplex's own copying takes along the weights of its pricing, and
  // reads beyond their end where columns came since they were made.
  Clp(const Clp& other)
      : simplex(static_cast<const ClpModel&>(other.simplex)),
        rows(other.rows),
        right_side(other.right_side),
        columns(other.columns),
        cost(other.cost),
        upper(other.upper) {
    simplex.setWhatsChanged(0);  // its working arrays are yet to be made
  }

  ClpSimplex simplex;
  const core::Deadline* deadline = nullptr;  // of the run
  // At most one of the two is not empty.
  Collected rows;
  std::vector<double> right_side;  // of the rows
  Collected columns;
  std::vector<double> cost;  // of the columns
  std::vector<double> upper;
};

LinearProgram::LinearProgram() : clp_(std::make_unique<Clp>()) {
  watch_deadline();
  clp_->simplex.setDualTolerance(kTolerance);
  clp_->simplex.setPrimalTolerance(kTolerance);
  clp_->simplex.resize(0, 0);
}

LinearProgram::LinearProgram(const LinearProgram& other)
    : clp_(std::make_unique<Clp>(*other.clp_)), iterations_(other.iterations_) {
  watch_deadline();
}

LinearProgram::~LinearProgram() = default;

void LinearProgram::watch_deadline() {
  const DeadlineEvent event(&clp_->deadline);
  clp_->simplex.passInEventHandler(&event);
  clp_->simplex.setLogLevel(0);
}

void LinearProgram::add_empty_rows(int count) {
  hand_over();
  const std::vector<double> lower(static_cast<std::size_t>(count), -COIN_DBL_MAX);
  const std::vector<double> upper(static_cast<std::size_t>(count), 1.0);
  const std::vector<CoinBigIndex> start(static_cast<std::size_t>(count) + 1, 0);
  clp_->simplex.addRows(count, lower.data(), upper.data(), start.data(), nullptr, nullptr);
}

void LinearProgram::add_row(SparseView row, double right_side) {
  hand_over_columns();
  clp_->rows.add(row);
  clp_->right_side.push_back(right_side);
}

void LinearProgram::add_column(SparseView column, double cost, double upper) {
  hand_over_rows();
  clp_->columns.add(column);
  clp_->cost.push_back(cost);
  clp_->upper.push_back(upper);
}

void LinearProgram::hand_over() {
  hand_over_rows();
  hand_over_columns();
}

void LinearProgram::hand_over_rows() {
  Collected& rows = clp_->rows;
  if (rows.size() == 0) return;
  const std::vector<double> lower(static_cast<std::size_t>(rows.size()), -COIN_DBL_MAX);
  clp_->simplex.addRows(rows.size(),
                        lower.data(),
                        clp_->right_side.data(),
                        rows.start.data(),
                        rows.index.data(),
                        rows.value.data());
  rows = {};
  clp_->right_side.clear();
}

void LinearProgram::hand_over_columns() {
  Collected& columns = clp_->columns;
  if (columns.size() == 0) return;
  const std::vector<double> lower(static_cast<std::size_t>(columns.size()), 0.0);
  clp_->simplex.addColumns(columns.size(),
                           lower.data(),
                           clp_->upper.data(),
                           clp_->cost.data(),
                           columns.start.data(),
                           columns.index.data(),
                           columns.value.data());
  columns = {};
  clp_->cost.clear();
  clp_->upper.clear();
}

void LinearProgram::remove_rows(std::span<const int> rows) {
  if (rows.empty()) return;
  hand_over();
  clp_->simplex.deleteRows(static_cast<int>(rows.size()), rows.data());
}

bool LinearProgram::is_slack(int row) const {
  return row >= clp_->simplex.numberRows() || clp_->simplex.getRowStatus(row) == ClpSimplex::basic;
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

void LinearProgram::set_lower(int column, double lower) {
  hand_over();
  clp_->simplex.setColumnLower(column, lower);
}

void LinearProgram::set_equality(int row, bool equality) {
  hand_over();
  ClpSimplex& simplex = clp_->simplex;
  simplex.setRowLower(row, equality ? simplex.rowUpper()[row] : -COIN_DBL_MAX);
}

int LinearProgram::num_rows() const {
  return clp_->simplex.numberRows() + clp_->rows.size();
}

int LinearProgram::num_columns() const {
  return clp_->simplex.numberColumns() + clp_->columns.size();
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

// Scale factors are computed anew in every solve, which over many rows takes longer than the few
// pivots that follow.  Over few rows they save pivots.
void LinearProgram::choose_scaling() {
  clp_->simplex.scaling(num_rows() > kMostScaledRows ? kNoScaling : kAutomaticScaling);
}

// Where the basis led into trouble, the one of slacks leads out of it.
template <typename Algorithm>
Outcome LinearProgram::run(const core::Deadline& deadline,
                           double objective_limit,
                           int max_iterations,
                           Algorithm algorithm) {
  ClpSimplex& simplex = clp_->simplex;
  clp_->deadline = &deadline;
  choose_scaling();
  for (const bool again : {false, true}) {
    // Once its seconds are over, CLP may call a start that it did not look at optimal.
    if (deadline.reached()) return Outcome::kStopped;
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
    if (simplex.status() == kStatusStopped || simplex.status() == kStatusStoppedByEvent)
      return Outcome::kStopped;
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

std::vector<unsigned char> LinearProgram::basis() {
  hand_over();
  const ClpSimplex& simplex = clp_->simplex;
  const unsigned char* status = simplex.statusArray();
  return {status, status + simplex.numberRows() + simplex.numberColumns()};
}

void LinearProgram::set_basis(const std::vector<unsigned char>& basis) {
  hand_over();
  clp_->simplex.copyinStatus(basis.data());
}

}  // namespace nda::lp
