#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/component.hpp"
#include "relax/relaxed_dual.hpp"

namespace nda::relax {

/// Answer to a relaxed problem (3.4): m kept sets, three or more as a rule.
struct KeptAnswer {
  core::Packing best;         ///< feasible; optimal if exact
  double lower = -kInfinity;  ///< no packing costs less, rounding included; -inf: out of time
  bool exact = false;         ///< best is optimal, to rounding
  std::vector<double> u;      ///< multipliers by slot: <= 0, all reduced costs >= 0

  /// Work of all calls so far: evaluations of dual functions below, nodes of exact searches.
  std::int64_t evaluations = 0;
  std::int64_t nodes = 0;
};

/// Solves a relaxed problem; injected by the layer above.  Structure and arcs are those of the last
/// call, the costs are others; `answer` holds the last answer, a start for this one (at first with
/// `u` empty), and receives the new one.
using KeptSolver = std::function<void(const core::Component& problem, KeptAnswer& answer)>;

/// How a dual function with any number of kept sets is put together.
struct KeptSets {
  int num_kept = 2;       ///< m; no more than N - 1 are kept of N
  bool merit = true;      ///< see KeptDual
  bool decompose = true;  ///< split the relaxed problem into components, once (4.7)
  KeptSolver solve;       ///< for m >= 3
};

/// The Lagrangian dual with m dimensions kept, for any m in 0 .. N - 1; relaxed problems of two and
/// more kept sets go to the injected solver.  Where that finds no optimum, a subgradient (4.4) is
/// that of the packing it found, and evaluate() returns
///
///     Psi, the lower bound that it proved: the report's merit function (4.5), <= q(u)  (4.6),
///     or without `merit` what the packing costs: the value of a plane that is nowhere below q.
///
/// For m = 2 DualFunction is much faster.
class KeptDual : public RelaxedDual {
 public:
  /// Keeps a reference to the component.
  KeptDual(const core::Component& component, const KeptSets& kept);

  std::int64_t evaluations() const;  ///< of all relaxed problems so far
  std::int64_t nodes() const;        ///< the same of exact searches

 private:
  // A component of the relaxed problem.
  struct Part {
    core::Component problem;
    std::vector<std::uint32_t> cells;  // [arc]
    std::vector<std::uint32_t> slots;  // [slot of the component]: slot of the problem, or 0
    KeptAnswer answer;
  };

  KeptValue solve_kept(std::span<const double> costs, std::vector<std::uint32_t>& chosen) override;
  void kept_multipliers(std::span<double> all) const override;
  void find_parts(bool decompose);
  double pay_singletons(std::span<const double> costs);
  void solve(Part& part, std::span<const double> costs, std::vector<std::uint32_t>& chosen);

  const KeptSets kept_;
  std::vector<std::uint32_t> singleton_cell_;  // [kept slot]: cell of that index alone, or kNoCell
  std::vector<double> singleton_;              // [kept slot]: what it costs, <= 0
  std::vector<bool> covered_;                  // [kept slot]
  std::vector<Part> parts_;
};

}  // namespace nda::relax
