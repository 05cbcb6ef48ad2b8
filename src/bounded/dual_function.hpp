#pragma once

#include <span>
#include <vector>

#include "assign2d/flow.hpp"
#include "bounded/relaxed_dual.hpp"

namespace nda::bounded {

/// The Lagrangian dual with at most two dimensions kept, Poore's choice: the choice of arcs is a
/// minimum-cost flow.  A component of at most two dimensions, both kept, has no variables, and q()
/// is its optimum.
class DualFunction : public RelaxedDual {
 public:
  /// Keeps a reference to the component.
  /// @param num_kept  in 0 .. 2; of a component of fewer dimensions all
  explicit DualFunction(const BoundedComponent& component, int num_kept = 2);

  /// Those of the flow for kept dimensions.  They prove q(u), to the accuracy of the flow; less
  /// where a cell has more arcs than both of its indices may use, but may use several: some sweeps
  /// of SeparableDual::ascend() make up for that.
  void multipliers(std::span<double> all) const override;

 private:
  KeptValue solve_kept(std::span<const core::ArcId> offered,
                       std::vector<core::ArcId>& chosen) override;
  std::vector<lap::FlowNode> nodes_of(int k) const;
  std::uint32_t node_of(int k, core::ArcId a) const;
  void keep_duals(const lap::FlowAnswer& answer);

  std::vector<lap::FlowNode> rows_;
  std::vector<lap::FlowNode> columns_;
  std::vector<lap::FlowEdge> edges_;
  std::vector<double> kept_u_;  // by kept slot, of the last flow
};

}  // namespace nda::bounded
