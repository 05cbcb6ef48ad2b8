#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "nda/problem.hpp"

namespace nda::mip {

// Methods side by side on the same problems, and a judge that sets their claims against each other.

/// Whose method it is.
enum class MethodKind { kNda, kBaseline, kExternal };

/// "nda", "baseline", "external".
const char* to_string(MethodKind kind);

/// What a method made of a problem.
struct MethodResult {
  std::string status;         ///< why it stopped, one word
  bool proven = false;        ///< it claims that its cost is the optimum, or that there is none
  double cost = kInfinity;    ///< recomputed from its arcs; +inf: no solution
  double bound = -kInfinity;  ///< it claims that no solution costs less; +inf: there is none
  double bound_error = 0;     ///< by which its bound may be off, absolute
  double seconds = 0;
  std::string note;    ///< one line on what is unusual; empty as a rule
  std::string method;  ///< set by run_methods()
  MethodKind kind = MethodKind::kNda;
  bool faulty = false;  ///< a defect of ours: it threw, or check() refuses what it returned

  bool has_solution() const { return cost < kInfinity; }
  bool has_bound() const { return bound > -kInfinity; }
  /// (cost - bound) / max(1e-9, |cost|); +inf when either is missing.
  double relative_gap() const;
};

struct RunLimits {
  double time_limit_s = kInfinity;  ///< per method; baselines know none
  std::stop_token stop = {};
};

/// A method under its name.
struct Contender {
  std::string name;
  MethodKind kind = MethodKind::kNda;
  std::string about;  ///< one line
  /// Why it is not meant for this problem ("more than 32 arcs"); empty when it is.
  std::function<std::string(const Problem&)> unfit;
  std::function<MethodResult(const Problem&, const RunLimits&)> run;
};

/// All results on one problem.
struct FileComparison {
  std::string file;
  std::vector<Index> sizes;
  std::size_t num_arcs = 0;
  double largest_cost = 0;  ///< absolute value, of arcs and singletons
  std::vector<MethodResult> results;

  double best_cost() const;   ///< +inf if none
  double best_bound() const;  ///< of all that claim one; -inf if none
};

/// Runs one method after the other; those unfit become "skipped", those after a stop "interrupted".
/// `before` and `after` are called around each run (not around skipped ones).
struct Watcher {
  std::function<void(const Contender&)> before = [](const Contender&) {};
  std::function<void(const MethodResult&)> after = [](const MethodResult&) {};
};
FileComparison run_methods(const std::string& file,
                           const Problem& problem,
                           const std::vector<Contender>& methods,
                           const RunLimits& limits,
                           const Watcher& watcher = {});

/// True when two costs or bounds are the same but for rounding: 1e-9 of the larger, or 1e-12 of the
/// largest cost of the problem.
bool same_value(const FileComparison& comparison, double a, double b);

/// One sentence for every pair of methods that cannot both be right, and for every faulty one.  A
/// bound contradicts a cost when it exceeds it by more than 1e-6 of the larger of the two, plus
/// 1e-9 of the largest cost of the problem, plus the bound's own error.
std::vector<std::string> contradictions(const FileComparison& comparison);

}  // namespace nda::mip
