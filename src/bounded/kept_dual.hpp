#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bounded/relaxed_dual.hpp"

namespace nda::bounded {

/// Answer to a relaxed problem (3.4): m kept dimensions, three or more as a rule.
struct KeptAnswer {
  Choice best;                ///< exceeds no bound; optimal if exact
  double lower = -kInfinity;  ///< no choice costs less, rounding included; -inf: out of time
  bool exact = false;         ///< best is optimal, to rounding
  std::vector<double> u;      ///< multipliers by slot

  /// Work of all calls so far: evaluations of dual functions below, nodes of exact searches.
  std::int64_t evaluations = 0;
  std::int64_t nodes = 0;
};

/// Solves a relaxed problem.  Slots and rows are those of the last call, arcs and costs are others;
/// `answer` holds the last answer, whose multipliers are a start, and receives the new one.
using KeptSolver = std::function<void(const BoundedComponent& problem, KeptAnswer& answer)>;

/// The Lagrangian dual with m dimensions kept, for any m in 0 .. N: the relaxed problem is one with
/// bounds in m dimensions and goes to the injected solver.  Where that finds no optimum, a
/// subgradient (4.4) is that of the choice it found, and evaluate() returns
///
///     Psi, the lower bound that it proved: the report's merit function (4.5), <= q(u)  (4.6),
///
/// or without `merit` what the choice costs: the value of a plane that is nowhere below q.
/// For m <= 2 DualFunction is much faster.
class KeptDual : public RelaxedDual {
 public:
  /// Keeps a reference to the component.
  KeptDual(const BoundedComponent& component, int num_kept, KeptSolver solve, bool merit = true);

  void multipliers(std::span<double> all) const override;

  /// Of the last evaluation.
  const KeptAnswer& answer() const { return answer_; }

 private:
  KeptValue solve_kept(std::span<const core::ArcId> offered,
                       std::vector<core::ArcId>& chosen) override;

  const KeptSolver solve_;
  const bool merit_;
  BoundedComponent problem_;
  KeptAnswer answer_;
};

}  // namespace nda::bounded
