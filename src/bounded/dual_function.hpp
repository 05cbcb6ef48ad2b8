#pragma once

#include <span>
#include <vector>

#include "assign2d/flow.hpp"
#include "bounded/bounded_component.hpp"
#include "dual/concave_function.hpp"

namespace nda::bounded {

/// The Lagrangian dual of a component with dimensions 2..N-1 relaxed and 0 and 1 kept (report,
/// sections 3.1 and 4.1, with bounds).  For any u,
///
///     q(u) = sum over relaxed indices of min over 0 <= n <= hi of f(n) + u n
///          + the best choice of arcs at their reduced costs where only dimensions 0 and 1 count
///
/// is concave and q(u) <= optimum.  The choice is a minimum-cost flow.  A cell, the arcs that agree
/// in the first two indices, may be used as often as both of them: its cheapest arcs so many are
/// edges side by side, where the one-to-one collapse of eq. (3.3) keeps the cheapest alone.
///
/// Variables are the slots from dimension 2 on, dummies included (their value must be 0, their
/// subgradient is 0).  A component of at most two dimensions has none, and q() is its optimum.
class DualFunction : public dual::ConcaveFunction {
 public:
  /// Keeps a reference to the component.
  explicit DualFunction(const BoundedComponent& component);

  std::size_t num_variables() const override { return component_.rows.size() - first_slot_; }
  std::uint32_t first_slot() const { return first_slot_; }

  /// Cost: O(A N) and one network simplex.
  double evaluate(std::span<const double> u, std::span<double> subgradient) override;

  /// The arcs of the last relaxed solution, ascending.
  std::span<const core::ArcId> chosen_arcs() const { return chosen_; }

  /// Multipliers of all slots at the last point: those of the flow for dimensions 0 and 1.  They
  /// prove q(u), to the accuracy of the flow; less where a cell has more arcs than both of its
  /// indices may use, but may use several.
  void multipliers(std::span<double> all) const;

 private:
  void find_cells();
  void collapse();
  void keep_cheapest(std::size_t first, std::size_t last, Index most);
  void add_edge(core::ArcId a, Index most);
  double take_flow(const lap::FlowAnswer& answer);

  const BoundedComponent& component_;
  std::uint32_t first_slot_ = 0;
  std::vector<lap::FlowNode> rows_;
  std::vector<lap::FlowNode> columns_;
  std::vector<core::ArcId> by_cell_;  // all arcs, those of a cell side by side
  std::vector<std::size_t> cell_;     // where each begins, and the end
  std::vector<double> r_;             // [arc] without dimensions 0 and 1
  std::vector<lap::FlowEdge> edges_;
  std::vector<core::ArcId> edge_arc_;
  std::vector<core::ArcId> chosen_;
  std::vector<double> slot_u_;  // by slot; of dimensions 0 and 1 those of the last flow
};

}  // namespace nda::bounded
