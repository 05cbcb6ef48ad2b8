#include "assign2d/network_simplex.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "assign2d/flow.hpp"
#include "assign2d/start.hpp"
#include "core/double_double.hpp"

// The assignment is a flow whose every node is used once (assign2d/flow).  Where its duals are not
// exact the shortest path solver repairs the last digits; where there is none it names the Hall
// set.
//
// With bounds the flow is the answer.  Bounds that exceed the number of pairs are cut down to it,
// which keeps the numbers of the flow small: uses that no pair is left for are paid alone.

namespace nda::lap {
namespace {

std::vector<FlowEdge> edges_of(const Assign2dProblem& problem) {
  std::vector<FlowEdge> edges;
  edges.reserve(problem.cost.size());
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    for (std::uint32_t k = problem.row_start[i]; k < problem.row_start[i + 1]; ++k)
      edges.push_back({i, problem.column[k], problem.cost[k]});
  }
  return edges;
}

std::vector<FlowNode> nodes_of(std::span<const double> outside) {
  std::vector<FlowNode> nodes;
  for (const double single : outside) nodes.push_back({single, 1, 1});
  return nodes;
}

// One side of a problem with bounds.
struct BoundedSide {
  std::span<const double> outside;
  std::vector<Index> num_pairs;   // that are not forbidden
  std::vector<UseBounds> bounds;  // as asked for, but lo = hi where being outside pays
  std::vector<FlowNode> nodes;    // with bounds no higher than there are pairs
  bool feasible = true;           // every lo that must be met can be

  BoundedSide(std::span<const double> singles,
              std::span<const UseBounds> asked,
              std::span<const Index> pairs)
      : outside(singles),
        num_pairs(pairs.begin(), pairs.end()),
        bounds(asked.begin(), asked.end()) {
    bounds.resize(singles.size());
    for (std::size_t i = 0; i < singles.size(); ++i) {
      if (singles[i] < 0) bounds[i].lo = bounds[i].hi;
      const Index hi = std::min(bounds[i].hi, num_pairs[i]);
      nodes.push_back({singles[i], std::min(bounds[i].lo, hi), hi});
      feasible = feasible && (bounds[i].lo <= hi || singles[i] < kInfinity);
    }
  }

  // Where there are fewer pairs than lo each refunds the outside cost: that is what a use is worth.
  // Elsewhere it is worth no more, and nothing is held back where there are no more pairs than hi.
  void clamp_duals(std::vector<double>& u) const {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double most = bounds[i].lo > 0 ? outside[i] : 0.0;
      if (bounds[i].lo > nodes[i].lo) {
        u[i] = most;
      } else if (bounds[i].hi >= num_pairs[i]) {
        u[i] = std::max(u[i], std::min(0.0, outside[i]));
      }
      u[i] = std::min(u[i], most);
    }
  }

  double cost(std::size_t i, Index uses) const {
    return uses < bounds[i].lo ? outside[i] * (bounds[i].lo - uses) : 0.0;
  }
};

void become_infeasible(Assign2dResult& result) {
  result.feasible = false;
  result.cost = kInfinity;
}

}  // namespace

void NetworkSimplexSolver::do_solve(const Assign2dProblem& problem,
                                    Assign2dResult& result,
                                    bool /*warm*/) {
  reset(problem.num_rows(), problem.num_columns(), result);
  if (problem.has_bounds()) return solve_bounded(problem, result);
  std::fill(result.column_of_row.begin(), result.column_of_row.end(), kUnassigned);
  const std::vector<FlowEdge> edges = edges_of(problem);
  const FlowAnswer answer =
      solve_flow(nodes_of(problem.row_outside), nodes_of(problem.column_outside), edges);
  if (!answer.feasible) return finisher_.solve(problem, result);
  result.v = answer.v;
  std::vector<std::uint32_t> pair_of_row(problem.num_rows());
  for (const std::uint32_t pair : answer.chosen) {
    const FlowEdge& edge = edges[pair];
    result.column_of_row[edge.row] = static_cast<std::int32_t>(edge.column);
    result.row_of_column[edge.column] = static_cast<std::int32_t>(edge.row);
    pair_of_row[edge.row] = pair;
  }
  if (answer.exact) {
    finish(problem.row_outside, problem.column_outside, true, result, [&](std::uint32_t i) {
      return problem.cost[pair_of_row[i]];
    });
  } else {
    finisher_.solve_warm(problem, result);
  }
}

void NetworkSimplexSolver::solve_bounded(const Assign2dProblem& problem, Assign2dResult& result) {
  result.column_of_row.clear();
  result.row_of_column.clear();
  result.pairs.clear();
  const std::vector<FlowEdge> edges = edges_of(problem);
  std::vector<Index> row_pairs(problem.num_rows(), 0);
  std::vector<Index> column_pairs(problem.num_columns(), 0);
  for (const FlowEdge& edge : edges) {
    if (edge.cost == kInfinity) continue;
    ++row_pairs[edge.row];
    ++column_pairs[edge.column];
  }
  const BoundedSide rows(problem.row_outside, problem.row_bounds, row_pairs);
  const BoundedSide columns(problem.column_outside, problem.column_bounds, column_pairs);
  if (!rows.feasible || !columns.feasible) return become_infeasible(result);
  FlowAnswer answer = solve_flow(rows.nodes, columns.nodes, edges);
  if (!answer.feasible) return become_infeasible(result);
  result.pairs = std::move(answer.chosen);
  result.u = std::move(answer.u);
  result.v = std::move(answer.v);
  rows.clamp_duals(result.u);
  columns.clamp_duals(result.v);
  std::fill(row_pairs.begin(), row_pairs.end(), 0u);
  std::fill(column_pairs.begin(), column_pairs.end(), 0u);
  core::DoubleDouble cost;
  for (const std::uint32_t pair : result.pairs) {
    cost.add(edges[pair].cost);
    ++row_pairs[edges[pair].row];
    ++column_pairs[edges[pair].column];
  }
  for (std::size_t i = 0; i < row_pairs.size(); ++i) cost.add(rows.cost(i, row_pairs[i]));
  for (std::size_t j = 0; j < column_pairs.size(); ++j) cost.add(columns.cost(j, column_pairs[j]));
  result.cost = cost.high();
}

}  // namespace nda::lap
