#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/column.hpp"
#include "core/lists.hpp"
#include "core/shift.hpp"
#include "nda/problem.hpp"
#include "nda/types.hpp"

namespace nda::core {

/// Number of an arc within a component.
using ArcId = std::uint32_t;

/// A problem in shifted form, the form every algorithm works on.
///
/// After the cost shift (report, 4.8) c'[a] = c[a] - sum of the singleton costs of its indices,
/// every index may stay uncovered at cost 0, and the problem reads
///
///     minimise sum c'[a] x[a]   so that   every real index is used at most once,  x binary.
///
/// A *slot* numbers the pair (dimension k, index i) as offset[k] + i, dummies included; vectors
/// over slots (multipliers, owners) have num_slots() entries, and those of the dummies stay 0.
struct Component {
  std::vector<Index> sizes;           ///< M_k
  std::vector<std::uint32_t> offset;  ///< first slot (the dummy) of dimension k
  std::vector<Column> indices;        ///< [k][a], 0 = dummy; arcs in lexicographic order
  std::vector<double> costs;          ///< shifted cost c'[a]

  /// Where an arc came from: its number in the problem or component that was cut first; empty if
  /// this one was not cut out of another.
  std::vector<ArcId> arc_origin;

  /// Where a slot came from: dimension and index in the problem.
  std::vector<std::uint8_t> dimensions;  ///< [k]: dimension of the problem
  std::vector<Index> origin;             ///< [slot]: index in the problem, 0 for dummies

  int num_dimensions() const { return static_cast<int>(sizes.size()); }
  std::size_t num_arcs() const { return costs.size(); }
  std::size_t num_slots() const {
    return sizes.empty() ? 0 : offset.back() + sizes.back() + std::size_t{1};
  }
  /// Number of real indices.
  std::size_t num_indices() const { return num_slots() - sizes.size(); }

  Index index(int k, ArcId a) const { return indices[static_cast<std::size_t>(k)][a]; }
  std::uint32_t slot(int k, ArcId a) const {
    return offset[static_cast<std::size_t>(k)] + index(k, a);
  }
};

/// Calls visit(slot, dimension, index) for every real index of a component, the last two as the
/// problem numbers them.
template <typename Visit>
void for_each_index(const Component& component, Visit&& visit) {
  for (std::size_t k = 0; k < component.sizes.size(); ++k) {
    const std::uint32_t dummy = component.offset[k];
    for (std::uint32_t slot = dummy + 1; slot <= dummy + component.sizes[k]; ++slot)
      visit(slot, std::size_t{component.dimensions[k]}, component.origin[slot]);
  }
}

/// A feasible choice of arcs of a component and its shifted cost; empty = everything uncovered,
/// cost 0.
struct Packing {
  std::vector<ArcId> arcs;
  double cost = 0;
};

/// Largest |c'| of the arcs; 0 without any.
double largest_cost(const Component& component);

/// The packing of these arcs: ascending, the cost summed in that order.
Packing make_packing(const Component& component, std::vector<ArcId> arcs);

/// A component of these sizes with offsets set, without arcs; slots stand for themselves.
Component make_component(std::vector<Index> sizes);

/// Appends an arc given by its indices (num_dimensions() entries); arcs must come in lexicographic
/// order.
void append_arc(Component& component, std::span<const Index> tuple, double cost);

/// The whole problem as one component, with shifted costs and borrowed columns: 8 bytes an arc.
/// Arcs with c' >= 0 are kept, and indices that no arc uses; neither can harm.  The problem must
/// outlive it.
/// Without arcs where the deadline strikes.
Component whole_problem(const Problem& problem, const Shift& shift, const Deadline& deadline = {});

/// Cuts components out of a problem or a component; keeps its scratch memory between calls.
class Cutter {
 public:
  /// Keeps the arcs of `arcs` (ascending) and the indices they use, renumbered in order; dimensions
  /// without any are dropped.  arc_origin, dimensions and origin are carried along.
  /// Empty where the deadline strikes.  Cost: O(arcs * N + indices log indices).
  Component cut(const Component& source,
                std::span<const ArcId> arcs,
                const Deadline& deadline = {});

  /// The same out of a problem, with shifted costs; arc_origin are arcs of the problem.
  Component cut(const Problem& source,
                const Shift& shift,
                std::span<const ArcId> arcs,
                const Deadline& deadline = {});

 private:
  template <typename Source>
  Component cut_from(const Source& source, std::span<const ArcId> arcs, const Deadline& deadline);
  template <typename Source>
  bool find_used(const Source& source, std::span<const ArcId> arcs, const Deadline& deadline);
  template <typename Source>
  void number_used(const Source& source, Component& part);
  template <typename Source>
  bool copy_arcs(const Source& source,
                 std::span<const ArcId> arcs,
                 const Deadline& deadline,
                 Component& part) const;

  std::vector<Index> number_;        // [slot of the source]: new index, 0 between calls
  std::vector<std::uint32_t> used_;  // slots of the source
};

/// Number of arc a where it came from first: in the problem, if the component was cut out of one.
inline ArcId original_arc(const Component& component, ArcId a) {
  return component.arc_origin.empty() ? a : component.arc_origin[a];
}

/// 0..num_arcs-1.
std::vector<ArcId> all_arcs(const Component& component);

/// Where these arcs stand in an ascending list, in their order; those not in it are left out.
std::vector<ArcId> positions_in(std::span<const ArcId> ascending, std::span<const ArcId> arcs);

/// The inverse: what stands at these positions of a list, in their order.
std::vector<ArcId> at_positions(std::span<const ArcId> list, std::span<const ArcId> positions);

/// The arcs of every slot, each list in the order of `arcs`.
Lists<ArcId> list_by_slot(const Component& component, std::span<const ArcId> arcs);

/// The inverse: numbers in `component` of these original arcs, ascending.  All must be there.
std::vector<ArcId> arcs_from_original(const Component& component, std::vector<ArcId> originals);

/// Numbers in `whole` of arcs of `part`, which was cut out of it, at once or step by step;
/// ascending.
std::vector<ArcId> arcs_from_part(const Component& whole,
                                  const Component& part,
                                  std::vector<ArcId> arcs);

/// Values by slot of `whole`, restricted to the slots of `part`, which was cut out of it.
std::vector<double> restrict_slots(const Component& whole,
                                   std::span<const double> values,
                                   const Component& part);

/// By slot of `whole`: the same slot of `part`, which was cut out of it; 0, a dummy, where it has
/// none.
std::vector<std::uint32_t> slots_in_part(const Component& whole, const Component& part);

/// The inverse of restrict_slots(): writes values by slot of `part` to the same slots of `whole`,
/// where others keep theirs.
void extend_slots(const Component& part,
                  std::span<const double> values,
                  const Component& whole,
                  std::span<double> extended);

/// c'[a] - sum of u over the slots of a.
inline double reduced_cost(const Component& component, std::span<const double> u, ArcId a) {
  double r = component.costs[a];
  for (int k = 0; k < component.num_dimensions(); ++k) r -= u[component.slot(k, a)];
  return r;
}

/// Calls visit(slot) for every real index of arc a.
template <typename Visit>
void for_each_slot(const Component& component, ArcId a, Visit&& visit) {
  for (int k = 0; k < component.num_dimensions(); ++k) {
    const Index i = component.index(k, a);
    if (i != 0) visit(component.offset[static_cast<std::size_t>(k)] + i);
  }
}

}  // namespace nda::core
