#include "assign2d/ranking_subproblem.hpp"

#include <algorithm>

namespace nda::lap {
namespace {

double least_leaving(const RankingState& state,
                     const RankingCore& core,
                     const RankingSubproblem& subproblem,
                     std::uint32_t row) {
  const PairLines& pairs = core.by_row();
  const std::uint32_t held = state.column_of_row(row);
  double least = kInfinity;
  for (std::uint32_t k = pairs.start[row]; k < pairs.start[row + 1]; ++k) {
    const std::uint32_t j = pairs.partner[k];
    const double offer = pairs.cost[k] - state.v(j);
    if (!(offer < least) || j == held || !subproblem.is_open(state.row_of_column(j))) continue;
    if (subproblem.allows(row, j)) least = offer;
  }
  if (held != kNone && subproblem.allows(row, kNone)) {
    least = std::min(least, state.row_outside(row));
  }
  return std::max(0.0, least - state.u(row));
}

double least_entering(const RankingState& state,
                      const RankingCore& core,
                      const RankingSubproblem& subproblem,
                      std::uint32_t column) {
  const PairLines& pairs = core.by_column();
  const std::uint32_t holder = state.row_of_column(column);
  double least = state.column_outside(column);
  for (std::uint32_t k = pairs.start[column]; k < pairs.start[column + 1]; ++k) {
    const std::uint32_t i = pairs.partner[k];
    const double offer = pairs.cost[k] - state.u(i);
    if (offer < least && i != holder && subproblem.is_open(i)) least = offer;
  }
  return std::max(0.0, least - state.v(column));
}

}  // namespace

// The pair by which the row leaves and the one by which somebody enters its column are not the
// same, so both reduced costs are lost.  An unassigned row leaves no column: whoever makes way for
// it may go outside free of charge.
LeastLoss least_loss(const RankingState& state,
                     const RankingCore& core,
                     const RankingSubproblem& subproblem,
                     std::uint32_t row) {
  const std::uint32_t held = state.column_of_row(row);
  return {least_leaving(state, core, subproblem, row),
          held == kNone ? 0 : least_entering(state, core, subproblem, held)};
}

}  // namespace nda::lap
