#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "core/lists.hpp"

namespace nda::relax {

/// Where multipliers go for ascent to take few sweeps, see Ascent: beyond the middle; measured.
inline constexpr double kFastShare = 0.65;

/// Coordinate ascent of the separable dual (separable_dual.hpp) on some arcs of a component, as if
/// there were no others, with lists of the arcs of every index: two passes over them for an index
/// that moves, one for the others.
class Ascent {
 public:
  /// u by slot, <= 0; becomes 0 where an index has none of the arcs.  Cost: O(arcs N + slots).
  /// @param share  in [0, 1]: where multipliers go on the way from the cheapest use of their index
  ///               to the second cheapest; anywhere between is best for the index alone.
  Ascent(const core::Component& component,
         std::span<const core::ArcId> arcs,
         std::vector<double> u,
         double share = 0.5);

  /// SeparableDual::ascend() of every dimension, last to first, if share is one half; returns by
  /// how much the multiplier moved that moved most.  Moves of at most `least_move` are left out.
  double sweep(double least_move = 0);

  /// sweep() until nothing moves more than that, so many times, or until the deadline strikes.
  void climb(int max_sweeps, double least_move, const core::Deadline& deadline = {});

  /// Lifts or lowers every multiplier to the highest value that its arcs allow, dimension by
  /// dimension, last to first: the multipliers are then feasible for these arcs (as make_feasible()
  /// makes them).
  void tighten();

  const std::vector<double>& u() const { return u_; }
  /// sum of u: after tighten() a lower bound on every packing of these arcs.
  double bound() const;

 private:
  void move(std::uint32_t slot, double by);

  double share_;
  std::vector<double> u_;
  std::vector<double> r_;               // reduced costs, in the order of the arcs
  core::Lists<std::uint32_t> arcs_of_;  // [slot]: positions in that order
  std::vector<std::uint32_t> order_;    // slots of real indices with arcs, last dimension first
};

}  // namespace nda::relax
