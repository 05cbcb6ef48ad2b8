#include "assign2d/auction.hpp"

#include <algorithm>
#include <cmath>

#include "assign2d/offers.hpp"
#include "assign2d/start.hpp"

// Auction after Bertsekas & Castanon, "A forward/reverse auction algorithm for asymmetric
// assignment problems", Computational Optimization and Applications 1 (1992) 277-297, and
// Bertsekas, Castanon & Tsaknakis, "Reverse auction and the solution of inequality constrained
// assignment problems", SIAM J. Optimization 3 (1993) 268-297.
//
// Forward: a row in want takes its best column and raises the offer by the distance to the second
// best plus epsilon, whoever held the column bids again.  Reverse: columns in want bid for rows in
// the same way. Outside options are one more offer that nobody can outbid.  Invariant (epsilon
// complementary slackness): u + v <= c + epsilon, with equality c = u + v for chosen pairs, so that
// a complete round costs at most (rows + columns) epsilon more than the optimum.
//
// Differences.  A forward auction leaves assigned rows assigned and unassigned rows at u = outside,
// also during the reverse auction that follows; one forward and one reverse auction per epsilon
// therefore suffice and the papers' alternation and their threshold lambda are not needed.
//
// Rounds shrink epsilon until it is small against the costs; then the shortest path solver starts
// from the auction's prices and finds the exact optimum and duals (not only for integer costs),
// usually within a few short searches.  It is also the judge of infeasible problems, where an
// auction would be a price war without end: a round that needs too many bids is broken off.

namespace nda::lap {
namespace {

constexpr double kFirstEpsilon = 0.01;  // of the largest cost
constexpr double kEpsilonFactor = 0.2;  // from round to round
constexpr double kLastEpsilon = 1e-4;   // of the largest cost
constexpr std::size_t kBidsPerMember = 200;

double largest_finite(std::span<const double> costs) {
  double largest = 0;
  for (const double x : costs) {
    if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
  }
  return largest;
}

// Who has made no bid yet has no price.
void forget_infinite(std::vector<double>& duals) {
  std::replace_if(
      duals.begin(), duals.end(), [](double x) { return !std::isfinite(x); }, 0.0);
}

}  // namespace

template <class View>
bool AuctionSolver::hold_auction(const Phase<View>& phase, double epsilon) {
  bidders_.clear();
  for (std::uint32_t i = 0; i < phase.own.size(); ++i) {
    if (phase.own.in_want(i)) bidders_.push_back(i);
  }
  std::size_t budget = kBidsPerMember * phase.own.size();
  while (!bidders_.empty()) {
    if (budget-- == 0) return false;
    const std::uint32_t i = bidders_.back();
    bidders_.pop_back();
    stop_check_.spend(phase.view.start[i + 1] - phase.view.start[i]);
    const Offers best = best_offers(phase, i);
    if (best.first == kInfinity) return false;
    if (best.first_pair == kNone) {
      phase.own.dual[i] = best.first;
      continue;
    }
    const std::uint32_t j = phase.view.partner[best.first_pair];
    const double raise = std::min(best.second - best.first, span_) + epsilon;
    phase.other.dual[j] -= raise;
    phase.own.dual[i] = best.first + raise;
    const std::int32_t former = phase.other.mate[j];
    if (former != kUnassigned) {
      phase.own.mate[former] = kUnassigned;
      bidders_.push_back(static_cast<std::uint32_t>(former));
    }
    phase.match(i, j, best.first_pair);
  }
  return true;
}

bool AuctionSolver::run_round(const Assign2dProblem& problem,
                              double epsilon,
                              Assign2dResult& result) {
  const Side rows = row_side(problem, result);
  const Side columns = column_side(problem, result);
  std::fill(rows.mate.begin(), rows.mate.end(), kUnassigned);
  std::fill(columns.mate.begin(), columns.mate.end(), kUnassigned);
  std::fill(rows.dual.begin(), rows.dual.end(), -kInfinity);
  for (std::uint32_t j = 0; j < columns.size(); ++j) {
    columns.dual[j] = std::min(columns.dual[j], columns.outside[j]);
  }
  const RowView by_rows{problem.row_start, problem.column, problem.cost};
  if (!hold_auction(Phase<RowView>{by_rows, rows, columns, pair_of_row_}, epsilon)) return false;
  return !anyone_in_want(columns) ||
         hold_auction(Phase<ColumnView>{transpose_.view(problem), columns, rows, pair_of_row_},
                      epsilon);
}

void AuctionSolver::do_solve(const Assign2dProblem& problem, Assign2dResult& result, bool warm) {
  const RowView by_rows{problem.row_start, problem.column, problem.cost};
  const bool is_warm = start(by_rows,
                             problem.cost,
                             problem.row_outside,
                             problem.column_outside,
                             ColdStart::kColumnsSatisfied,
                             result,
                             warm);
  pair_of_row_.resize(problem.num_rows());
  const double scale = largest_finite(problem.cost);
  span_ = 2 * scale;
  const double last = kLastEpsilon * scale;
  double epsilon = is_warm ? last : kFirstEpsilon * scale;
  try {
    while (scale > 0 && run_round(problem, epsilon, result) && epsilon > last) {
      epsilon = std::max(last, epsilon * kEpsilonFactor);
    }
  } catch (const Assign2dInterrupted&) {
    forget_infinite(result.u);
    throw;
  }
  finisher_.solve_warm(problem, result);
}

}  // namespace nda::lap
