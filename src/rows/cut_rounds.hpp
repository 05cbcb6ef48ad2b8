#pragma once

#include <functional>
#include <span>
#include <vector>

#include "bnb/proof_log.hpp"
#include "core/clock.hpp"
#include "core/component.hpp"
#include "cutting/cut.hpp"
#include "nda/options.hpp"

namespace nda::rows {

/// Where a round of cuts has led; spans hold until the observer returns.
struct CutPoint {
  const core::Component& component;  ///< the arcs that may still be used: slots are those of it
  double lower;                      ///< no packing below the cutoff costs less
  std::span<const double> u;         ///< with `rows` they prove `lower`
  std::span<const cutting::CutRow> rows;
  /// The averaged relaxed solution: arcs of value above 0, nearly a point of the linear program.
  std::span<const core::ArcId> arcs;
  std::span<const double> values;
};

/// Called after every round; returns the cutoff from now on.
using CutPointObserver = std::function<double(const CutPoint&)>;

struct CutRoundOptions {
  /// kVolume or kBundleTrust, the two that average.
  DualMethod dual_method = DualMethod::kVolume;
  Assign2dMethod assign2d = Assign2dMethod::kShortestPath;
  int round_evaluations = 100;  ///< of the dual function; >= 1
  int max_rounds = 50;
  double cutoff = kInfinity;  ///< only packings cheaper than this are looked for
  /// Two rounds in a row that close less than this share of the gap are the last, and so are all
  /// without a cutoff.
  double worthwhile = 0.01;
  double least_violation = 0.05;   ///< of a cut that is added
  bnb::ProofLog* proof = nullptr;  ///< where to write down which arcs were dropped, and why
  core::Deadline deadline;
  double certify_s = 0;  ///< what a certificate takes, as far as is known: kept of the time
};

struct CutRoundsResult {
  double lower = -kInfinity;          ///< no packing below the last cutoff costs less
  std::vector<core::ArcId> live;      ///< arcs that such a packing may use, ascending
  std::vector<double> u;              ///< by slot of the component: with `rows` they prove it
  std::vector<cutting::CutRow> rows;  ///< by slots of the component, without entries
  int evaluations = 0;
  int rounds = 0;
};

/// Raises the Lagrangian bound of a component by cuts over three indices, without any linear
/// program: a dual method maximises CutDual, the averaged relaxed solution shows cuts that it
/// violates, these become rows; rows of multiplier 0 are dropped, and so are arcs whose reduced
/// cost leads to the cutoff.  Ends when that gains little, when the bound reaches the cutoff, or at
/// the deadline.
///
/// @param u  multipliers by slot to start from.
/// Cost: round_evaluations evaluations a round and one relax::make_feasible().
CutRoundsResult run_cut_rounds(const core::Component& component,
                               std::span<const double> u,
                               const CutRoundOptions& options,
                               const CutPointObserver& observer);

}  // namespace nda::rows
