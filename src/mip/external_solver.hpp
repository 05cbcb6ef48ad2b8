#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "mip/programs.hpp"
#include "nda/problem.hpp"

namespace nda::mip {

// General integer programming solvers, each run as a child process on the set partitioning model
//
//     minimise  sum c_a x_a + sum s_ki y_ki
//     for every index (k, i):  sum of x_a over arcs that contain it + y_ki = 1,   x, y binary
//
// (where an index has bounds lo..hi of its own: lo <= ... <= hi, y an integer from 0 to hi)
// with the costs as they are: no cost shift, no reduction; what the model allows, the solver's own
// presolve must find.  Columns are the arcs in the order of the problem, then the singletons that
// are not forbidden, dimension by dimension.

enum class ExternalStatus {
  kOptimal,      ///< the solver says so, to its own tolerances
  kTimeLimit,    ///< it stopped at the limit
  kKilled,       ///< it did not and was killed after the grace
  kInterrupted,  ///< killed on request
  kInfeasible,   ///< it says that no solution exists
  kWrong,        ///< its answer is no solution: `note` says why
  kFailed,       ///< no answer, or none that can be read: `note` says what is known
};

/// "optimal", "time_limit", "killed", "interrupted", "infeasible", "wrong", "failed".
const char* to_string(ExternalStatus status);

/// What is left of a solver's answer after verification.
struct ExternalAnswer {
  ExternalStatus status = ExternalStatus::kFailed;
  double cost = kInfinity;    ///< recomputed from the arcs by check(); +inf when there are none
  double bound = -kInfinity;  ///< the solver's word, lowered by what its output rounds
  double seconds = 0;  ///< wall time of the process: start, reading the model, solving, writing
  std::vector<std::vector<Index>> arcs;  ///< tuples with two or more real indices, lexicographic
  std::string note;                      ///< empty when all is well
};

struct ExternalLimits {
  double time_limit_s = kInfinity;  ///< told to the solver; above 0
  double grace_s = 2;  ///< killed so long after 1.1 times the limit: starting, reading and
                       ///< writing do not count for every solver
  std::stop_token stop = {};
};

/// What a solver's files say, before anyone has checked it.
struct RawAnswer {
  ExternalStatus status = ExternalStatus::kFailed;
  double objective = kInfinity;  ///< as stated; +inf when not
  double bound = -kInfinity;     ///< as stated; -inf when not
  bool has_solution = false;
  struct Column {
    std::size_t number;  ///< from 0
    std::size_t value;
  };
  std::vector<Column> columns;  ///< those above 0, ascending

  /// Notes the value of a column; one far from a whole number, or below 0, means that this is no
  /// solution after all.
  void take(std::size_t column, double value);
};

/// Largest absolute error that the solvers' default tolerances allow in a bound.
inline constexpr double kExternalTolerance = 1e-6;

/// One installed solver, at relative gap 0 and one thread.
///
/// solve() does what all have in common: temporary files (removed whatever happens), the process,
/// the clock, the checks.  What differs is the command line and the formats of the files.
class ExternalSolver {
 public:
  virtual ~ExternalSolver() = default;

  /// Never throws for what the solver does or leaves undone: that is a status.
  ExternalAnswer solve(const Problem& problem, const ExternalLimits& limits) const;

 protected:
  explicit ExternalSolver(std::string temporary_folder)
      : temporary_folder_(std::move(temporary_folder)) {}

  /// Names of the files in the folder of a run.
  static constexpr const char* kModelFile = "model.mps";
  static constexpr const char* kSolutionFile = "solution";
  static constexpr const char* kLogFile = "log";

  /// Writes the model into the folder of a run; here kModelFile, as free MPS.
  virtual void write_model(const Problem& problem, const std::string& folder) const;

 private:
  /// The program and its arguments; it works in the folder of the run.
  virtual std::vector<std::string> command(double time_limit_s) const = 0;

  /// Reads what it left there, which may be anything.
  virtual RawAnswer read_answer(const std::string& folder) const = 0;

  std::string temporary_folder_;
};

/// A solver that can be had.
struct ExternalKind {
  const char* name;     ///< "cbc"
  const char* about;    ///< one line
  const char* package;  ///< what brings it to Debian 12
  /// Null when it is not installed.
  std::unique_ptr<ExternalSolver> (*find)(const Surroundings& surroundings);
};

/// All of them, in a fixed order: cbc, glpk, scipy, highs.
std::span<const ExternalKind> external_kinds();

// The adapters.
std::unique_ptr<ExternalSolver> find_cbc(const Surroundings& surroundings);
std::unique_ptr<ExternalSolver> find_glpk(const Surroundings& surroundings);
std::unique_ptr<ExternalSolver> find_scipy(const Surroundings& surroundings);
std::unique_ptr<ExternalSolver> find_highs(const Surroundings& surroundings);

}  // namespace nda::mip
