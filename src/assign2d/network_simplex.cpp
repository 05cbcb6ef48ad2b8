#include "assign2d/network_simplex.hpp"

#include <lemon/network_simplex.h>
#include <lemon/smart_graph.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "assign2d/start.hpp"

// Minimum-cost flow: rows supply one unit, columns demand one, and one dummy node takes what rows
// leave and gives what columns lack (its supply is columns - rows).  A row's outside option is an
// arc to the dummy, a column's an arc from it; where the option is forbidden the arc is missing.
//
// LEMON's pivot rule compares reduced costs with zero exactly, which may cycle on rounding errors,
// so costs go in as 64-bit integers on the finest grid (a power of two) on which no potential
// overflows.  Costs that lie on the grid, integers among them, are solved exactly by LEMON alone;
// otherwise its duals are optimal to about 2^-40 of the largest cost and the shortest path solver
// repairs the last digits.
//
// LEMON does not say why a flow is infeasible: the shortest path solver names the Hall set.

namespace nda::lap {
namespace {

using Graph = lemon::SmartDigraph;
using Simplex = lemon::NetworkSimplex<Graph, int, std::int64_t>;

// Costs as multiples of a power of two.
class Grid {
 public:
  explicit Grid(const Assign2dProblem& problem) {
    double largest = 0;
    for (const auto& costs : {problem.cost, problem.row_outside, problem.column_outside}) {
      for (const double x : costs) {
        if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
      }
    }
    const std::size_t nodes = std::size_t{problem.num_rows()} + problem.num_columns() + 2;
    const int bits = 59 - static_cast<int>(std::bit_width(nodes));
    int exponent = 0;
    std::frexp(largest, &exponent);
    shift_ = bits - exponent;
  }

  std::int64_t round(double x) {
    const double scaled = std::ldexp(x, shift_);
    const double rounded = std::nearbyint(scaled);
    exact_ = exact_ && rounded == scaled;
    return static_cast<std::int64_t>(rounded);
  }
  double value(std::int64_t x) const { return std::ldexp(static_cast<double>(x), -shift_); }
  bool exact() const { return exact_; }

 private:
  int shift_ = 0;
  bool exact_ = true;
};

// The flow network of a problem.
struct Network {
  explicit Network(const Assign2dProblem& problem);

  Grid grid;
  Graph graph;
  std::vector<Graph::Node> rows;
  std::vector<Graph::Node> columns;
  Graph::Node dummy;
  std::vector<Graph::Arc> pairs;  // INVALID where forbidden
  Graph::ArcMap<std::int64_t> cost;
  Graph::NodeMap<int> supply;

 private:
  Graph::Arc add_arc(Graph::Node from, Graph::Node to, double c) {
    if (c == kInfinity) return lemon::INVALID;
    const Graph::Arc arc = graph.addArc(from, to);
    cost[arc] = grid.round(c);
    return arc;
  }
};

Network::Network(const Assign2dProblem& problem) : grid(problem), cost(graph), supply(graph, 0) {
  graph.reserveArc(static_cast<int>(problem.cost.size()));
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) rows.push_back(graph.addNode());
  for (std::uint32_t j = 0; j < problem.num_columns(); ++j) columns.push_back(graph.addNode());
  dummy = graph.addNode();
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    supply[rows[i]] = 1;
    for (std::uint32_t k = problem.row_start[i]; k < problem.row_start[i + 1]; ++k) {
      pairs.push_back(add_arc(rows[i], columns[problem.column[k]], problem.cost[k]));
    }
    add_arc(rows[i], dummy, problem.row_outside[i]);
  }
  for (std::uint32_t j = 0; j < problem.num_columns(); ++j) {
    supply[columns[j]] = -1;
    add_arc(dummy, columns[j], problem.column_outside[j]);
  }
  supply[dummy] = static_cast<int>(problem.num_columns()) - static_cast<int>(problem.num_rows());
}

// Assignment and v from an optimal flow; the potential of the dummy node is the zero of the duals.
void read_flow(const Assign2dProblem& problem,
               const Network& network,
               const Simplex& simplex,
               std::vector<std::uint32_t>& pair_of_row,
               Assign2dResult& result) {
  const std::int64_t zero = simplex.potential(network.dummy);
  for (std::uint32_t j = 0; j < problem.num_columns(); ++j) {
    result.v[j] = network.grid.value(simplex.potential(network.columns[j]) - zero);
  }
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    for (std::uint32_t k = problem.row_start[i]; k < problem.row_start[i + 1]; ++k) {
      if (network.pairs[k] == lemon::INVALID || simplex.flow(network.pairs[k]) == 0) continue;
      result.column_of_row[i] = static_cast<std::int32_t>(problem.column[k]);
      result.row_of_column[problem.column[k]] = static_cast<std::int32_t>(i);
      pair_of_row[i] = k;
    }
  }
}

}  // namespace

void NetworkSimplexSolver::do_solve(const Assign2dProblem& problem,
                                    Assign2dResult& result,
                                    bool /*warm*/) {
  reset(problem.num_rows(), problem.num_columns(), result);
  std::fill(result.column_of_row.begin(), result.column_of_row.end(), kUnassigned);
  Network network(problem);
  Simplex simplex(network.graph);
  simplex.supplyMap(network.supply).costMap(network.cost);
  if (simplex.run() != Simplex::OPTIMAL) {
    finisher_.solve(problem, result);
    return;
  }
  std::vector<std::uint32_t> pair_of_row(problem.num_rows());
  read_flow(problem, network, simplex, pair_of_row, result);
  if (network.grid.exact()) {
    finish(problem.row_outside, problem.column_outside, true, result, [&](std::uint32_t i) {
      return problem.cost[pair_of_row[i]];
    });
  } else {
    finisher_.solve_warm(problem, result);
  }
}

}  // namespace nda::lap
