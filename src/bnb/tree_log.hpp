#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bnb/proof_log.hpp"
#include "core/component.hpp"

namespace nda::bnb {

/// An arc that every better packing uses: all other uses of one of its indices are too dear.
struct ForcedArc {
  core::ArcId arc;     ///< of the component that was reduced
  std::uint32_t slot;  ///< the index
};

/// What branch and bound does, step by step, for a ProofLog; without one it does nothing.
///
/// Multipliers are by slot of the component that comes with them, whose slots are a part of what
/// the log is about at that point; what the log is about besides has no arcs left.
class TreeLog {
 public:
  /// @param log  may be null.
  explicit TreeLog(ProofLog* log) : log_(log) {}

  void bound(const core::Component& component, std::span<const double> u);
  void search(const core::Component& component, std::span<const double> u, double threshold);

  /// Arcs were dropped by reduced cost, and the rivals of forced arcs.
  void fix(const core::Component& component,
           std::span<const double> u,
           double threshold,
           std::span<const ForcedArc> forced);

  /// Branches on the uses of an index.  Children follow, each between use() and leave(), then
  /// others(): each use that is left raises the bound by `penalty`.
  std::size_t cover(const core::Component& component, std::uint32_t slot);
  /// @param step  what cover() returned.
  void use(std::size_t step, const core::Component& component, core::ArcId arc);
  void use_none(std::size_t step, const core::Component& component, std::uint32_t slot);
  void others(const core::Component& component,
              std::span<const double> u,
              std::uint32_t slot,
              double penalty);

  /// What is left falls apart.  The parts follow in their order, each between group() and leave(),
  /// then rest(): forced arcs and indices without arcs.
  void split(std::span<const core::Component* const> parts);
  void group(const core::Component& part);
  void rest(const core::Component& component,
            std::span<const double> u,
            std::span<const ForcedArc> forced,
            std::span<const core::Component* const> parts);

  void leave();

 private:
  ProofLog* log_;
};

}  // namespace nda::bnb
