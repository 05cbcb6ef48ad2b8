#pragma once

#include <optional>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "core/shift.hpp"
#include "nda/problem.hpp"
#include "nda/solution.hpp"
#include "nda/warm_start.hpp"
#include "solve/component_solver.hpp"

namespace nda::pipeline {

/// What a warm start proves of a problem before it is split: which arcs are settled, which are
/// open, and multipliers (docs/hot_starts.md).  Some best packing consists of the settled arcs and
/// a best packing of the open ones, within the error or, on a grid, exactly.
struct HotStart {
  core::Component live;   ///< the arcs that can improve on their singletons; slots as in the
                          ///< problem
  std::vector<double> u;  ///< by slot of `live`, feasible
  double lower = 0;       ///< sum u
  std::vector<core::ArcId> settled;  ///< arcs of the problem that a best packing has, ascending
  double settled_cost = 0;           ///< shifted
  std::vector<double> learned_u;     ///< by slot of `live`: of the last round that saw an index
  core::Component open;              ///< cut out of `live`
  std::vector<double> open_u;        ///< u by slot of `open`
  std::vector<char> is_best;         ///< by arc of `open`: in the best packing so far
  Precision precision;               ///< of the whole
  ExchangeYield yield;
};

/// Nothing where the deadline strikes, or where no arc is live.  No singleton of the problem may be
/// forbidden.  Never wrong, whatever the warm start says.
/// Cost: some passes over the arcs, more over those of little reduced cost.
std::optional<HotStart> make_hot_start(const Problem& problem,
                                       const core::Shift& shift,
                                       const core::CostGrid& grid,
                                       const WarmStart& warm,
                                       const core::Deadline& deadline);

/// A part of `open`, a connected component of these arcs, and what is known of it.
struct HotPart {
  core::Component component;
  Hint hint;
};
HotPart cut_part(const HotStart& hot,
                 std::span<const core::ArcId> arcs,
                 core::Cutter& cutter,
                 const core::Deadline& deadline);

/// Keeps multipliers of a part, by its slots, for add_multipliers().
void learn(HotStart& hot, const core::Component& part, std::span<const double> u);

/// Adds what it did; the arcs of parts of `open` are counted with these.
void count(const HotStart& hot, Stats& stats);

/// Adds to multipliers[k][i-1] those of the hot start, or those that it learned, made feasible: the
/// ones that prove more.
void add_multipliers(HotStart& hot, std::vector<std::vector<double>>& multipliers);

}  // namespace nda::pipeline
