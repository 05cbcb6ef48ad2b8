#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "nda/assign2d.hpp"
#include "relax/relaxed_dual.hpp"

namespace nda::relax {

/// The Lagrangian dual with dimensions 0 and 1 kept (m = 2), Poore's choice: the best packing of
/// the kept indices is a least-cost assignment of d, rows and columns free to stay out at
/// min(0, d(i1, 0)) and min(0, d(0, i2)), warm-started; no allocation after the first evaluation.
///
/// A component of two dimensions has no variables, and q() is its optimum.
class DualFunction : public RelaxedDual {
 public:
  /// Keeps a reference to the component.
  explicit DualFunction(const core::Component& component,
                        Assign2dMethod method = Assign2dMethod::kShortestPath,
                        const core::Deadline& deadline = {});
  ~DualFunction() override;

  /// The two-dimensional problem of the last evaluation, until the next one or the end of this.
  Assign2dProblem assignment() const;
  /// The alignment that an answer to assignment() is.
  std::vector<std::uint32_t> cells_of(const Assign2dResult& answer) const;

 private:
  struct Assignment;

  KeptValue solve_kept(std::span<const double> costs, std::vector<std::uint32_t>& chosen) override;
  void kept_multipliers(std::span<double> all) const override;
  template <typename Visit>
  void for_each_chosen_cell(const Assign2dResult& answer, Visit&& visit) const;

  std::unique_ptr<Assignment> assignment_;
};

}  // namespace nda::relax
