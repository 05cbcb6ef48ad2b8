#include "kbest/clique_ranking.hpp"

#include <cmath>
#include <vector>

#include "bnb/clique_search.hpp"

// An arc gains the prices of its rows less its reduced cost, so the slack of a packing is that of
// using nothing less what its arcs gain, and multipliers cancel.  Where slacks lie on a grid, so do
// the gains.

namespace nda::kbest {
namespace {

constexpr double kMostUnits = 0x1p60;
constexpr double kTolerance = 0x1p-6;  // of a step: what the budget just pays for is found

struct Gains {
  bnb::CliqueProblem problem;
  double empty = 0;  // slack of using nothing
  double total = 0;  // of all gains, in size
};

Gains gains_of(const bnb::SlackProblem& slack) {
  Gains gains;
  for (std::uint32_t row = 0; row < slack.num_rows(); ++row)
    gains.empty += slack.capacity(row) * slack.price(row);
  std::vector<std::uint32_t> rows;
  for (std::uint32_t a = 0; a < slack.num_arcs(); ++a) {
    double gain = -slack.reduced(a);
    rows.clear();
    for (const bnb::RowUse use : slack.uses(a)) {
      gain += slack.price(use.row);
      rows.push_back(use.row);
    }
    gains.total += std::abs(gain);
    gains.problem.add_arc(gain, rows);
  }
  return gains;
}

}  // namespace

bool may_rank_cliques(const bnb::SlackProblem& problem) {
  if (problem.num_arcs() > bnb::kMostCliqueArcs) return false;
  if (problem.num_rows() > problem.num_indices()) return false;
  for (std::uint32_t row = 0; row < problem.num_rows(); ++row) {
    if (problem.price(row) == kInfinity) return false;
  }
  return true;
}

SlackRanking rank_cliques(const bnb::SlackProblem& problem,
                          double budget,
                          std::size_t k,
                          double step,
                          const bnb::SlackLimits& limits,
                          std::span<const std::uint32_t> names,
                          Combinations& combinations) {
  const Gains gains = gains_of(problem);
  if (!(gains.total < kMostUnits * step)) step = 0;
  const bnb::CliqueRanking found =
      bnb::rank_cliques(gains.problem,
                        k,
                        gains.empty - budget - kTolerance * step,
                        step,
                        {limits.max_nodes, limits.max_work, limits.deadline});
  SlackRanking ranking;
  for (const bnb::CliquePacking& packing : found.packings) {
    Combination arcs = kNothing;
    for (const std::uint32_t a : packing.arcs)
      arcs = combinations.join(arcs, combinations.single(names[a]));
    ranking.packings.push_back({gains.empty - packing.gain, arcs});
  }
  ranking.complete = found.complete;
  ranking.next = ranking.packings.size() == k ? ranking.packings.back().slack : budget;
  ranking.nodes = found.nodes;
  ranking.work = found.work;
  return ranking;
}

}  // namespace nda::kbest
