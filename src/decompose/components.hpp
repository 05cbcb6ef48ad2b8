#pragma once

#include <span>
#include <vector>

#include "core/component.hpp"
#include "core/shift.hpp"
#include "nda/problem.hpp"

namespace nda::decompose {

/// The arcs of every connected component, one component after the other.
struct Partition {
  std::vector<core::ArcId> arcs;  ///< ascending within a component
  std::vector<std::size_t>
      start;  ///< first arc of every component, and the end: num_components() + 1

  std::size_t num_components() const { return start.empty() ? 0 : start.size() - 1; }
  std::span<const core::ArcId> component(std::size_t c) const {
    return std::span(arcs).subspan(start[c], start[c + 1] - start[c]);
  }
};

/// The connected components of a problem: indices are vertices, an arc connects its real indices.
/// Arcs that cannot improve on the singletons of their indices (c'[a] >= 0) are left out first, so
/// some optimal solution consists of an optimal solution of every component.  (They matter to the
/// second best!) Components come in the order of their smallest arc.  No components at all where
/// the deadline strikes.  Cost: O(A N alpha), 8 bytes an arc.  Source: report, section 4.7.
Partition partition(const Problem& problem,
                    const core::Shift& shift,
                    const core::Deadline& deadline = {});

/// Makes one component of them all.
void join(Partition& partition);

/// The connected components of a component; all its arcs count.
Partition partition(const core::Component& component, const core::Deadline& deadline = {});

}  // namespace nda::decompose
