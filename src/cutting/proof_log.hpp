#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/component.hpp"
#include "cutting/master.hpp"
#include "nda/proof.hpp"

namespace nda::cutting {

/// Writes down the steps of a proof about one component, in the terms of nda/proof.hpp: positions
/// are the slots of the component without the dummies, costs are those of the problem.
class ProofLog {
 public:
  /// @param base   by slot: what the shift charges; multipliers and thresholds come shifted.
  /// @param slack  thresholds are lowered by it: what rounding may make of a reduced cost.
  ProofLog(const core::Component& component, std::vector<double> base, double slack);

  /// From now on slots are those of `part`, which was cut out of the component.
  void enter(const core::Component& part);

  void fix(std::span<const double> u, double threshold);
  void fix(const Master& master, double threshold);
  void bound(std::span<const double> u);
  void bound(const Master& master);
  void search(std::span<const double> u, double threshold);
  /// By the cuts of `master` and other multipliers than its own.
  void search(const Master& master, std::span<const double> u, double threshold);
  /// By what arcs gain over `u`; empty = 0 for all.
  void cliques(std::span<const double> u, double threshold);
  /// The two children follow, in this order.
  void branch(std::uint32_t first, std::uint32_t second, bool together_first);

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

 private:
  ProofLog() = default;
  ProofPoint point(std::span<const double> u);
  ProofPoint point(const Master& master, std::span<const double> u);
  double unshifted(double threshold) const { return threshold + constant_ - slack_; }

  std::vector<double> base_;                             // by position
  std::vector<double> multipliers_;                      // by position: of the last step
  std::vector<std::vector<std::uint32_t>> position_of_;  // [dimension of the problem][its index]
  std::vector<std::uint32_t> position_;                  // by slot, of what was entered last
  double constant_ = 0;
  double slack_ = 0;
  ProofPart part_;
};

}  // namespace nda::cutting
