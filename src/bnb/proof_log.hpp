#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/component.hpp"
#include "nda/proof.hpp"

namespace nda::bnb {

/// Writes down the steps of a proof about one component, in the terms of nda/proof.hpp: positions
/// are the slots of the component without the dummies, costs are those of the problem.
///
/// Cuts come with the slots of their indices in place of positions.
class ProofLog {
 public:
  /// @param base   by slot: what the shift charges; multipliers and thresholds come shifted.
  /// @param slack  thresholds are lowered by it: what rounding may make of a reduced cost.
  ProofLog(const core::Component& component, std::vector<double> base, double slack);

  /// From now on slots are those of `part`, which was cut out of the component.
  void enter(const core::Component& part);

  void fix(std::span<const double> u, double threshold, std::vector<ProofCut> cuts = {});
  void bound(std::span<const double> u, std::vector<ProofCut> cuts = {});
  void search(std::span<const double> u, double threshold, std::vector<ProofCut> cuts = {});
  /// By what arcs gain over `u`; empty = 0 for all.
  void cliques(std::span<const double> u, double threshold);
  /// The two children follow, in this order.
  void branch(std::uint32_t first, std::uint32_t second, bool together_first);
  /// Children follow, each between use() and leave(), then one in which none of the uses is made.
  /// Returns the number of the step.
  std::size_t cover(std::uint32_t slot);
  /// @param step   that of cover().
  /// @param arc    of the problem, from 1; 0 = none.
  /// @param slots  that are done with: those of the arc, or the index alone.
  void use(std::size_t step, std::uint32_t arc, std::span<const std::uint32_t> slots);
  /// Children follow, one for each part, between group() and leave(), then one of the indices that
  /// are in none of these parts, between rest() and leave().
  void split(std::span<const core::Component* const> parts);
  void group(const core::Component& part);
  void rest(std::span<const core::Component* const> parts);
  void leave() { scopes_.pop_back(); }

  std::size_t size() const { return part_.steps.size(); }
  /// Forgets all steps from number `size` on.
  void cut_back(std::size_t size);

  /// A log without steps, for a subtree that is explored apart.
  ProofLog fork() const;
  /// Inserts the steps of a fork, which are then gone from it, before the step of this number.
  struct Graft {
    std::size_t place;
    ProofLog* fork;
  };
  /// @param grafts  places ascend.
  void graft(std::span<const Graft> grafts);

  /// Gives the steps away.
  ProofPart take() { return std::move(part_); }
  /// Takes the steps of a fork in place of its own.
  void replace(ProofLog&& fork);

 private:
  // What steps are about: the positions that are left, and what these are charged.
  struct Scope {
    std::vector<std::uint32_t> positions;
    double constant = 0;
  };

  ProofLog() = default;
  ProofPoint point(std::span<const double> u, std::vector<ProofCut> cuts);
  double unshifted(double threshold) const { return threshold + scopes_.back().constant - slack_; }
  std::vector<std::uint32_t> positions_of(const core::Component& part) const;
  Scope scope_of(std::vector<std::uint32_t> positions) const;
  void leave_out(std::span<const std::uint32_t> positions);

  std::vector<double> base_;                             // by position
  std::vector<double> multipliers_;                      // by position: of the last step
  std::vector<double> wanted_;                           // by position: of the step at hand
  std::vector<std::vector<std::uint32_t>> position_of_;  // [dimension of the problem][its index]
  std::vector<std::uint32_t> position_;                  // by slot, of what was entered last
  std::vector<Scope> scopes_;                            // each within the one before
  double slack_ = 0;
  ProofPart part_;
};

}  // namespace nda::bnb
