#include "assign2d/flow.hpp"

#include <lemon/network_simplex.h>
#include <lemon/smart_graph.h>

#include <algorithm>
#include <bit>
#include <cmath>

// Minimum-cost flow: rows supply their lower bound, columns demand theirs, and one dummy node takes
// what rows leave and gives what columns lack.  A use that a row does without is an arc to the
// dummy at the price of its singleton, one beyond its lower bound comes from the dummy free of
// charge; of a column the other way round.  Where a singleton is forbidden its arc is missing.
//
// LEMON's pivot rule compares reduced costs with zero exactly, which may cycle on rounding errors,
// so costs go in as 64-bit integers on the finest grid (a power of two) on which no potential
// overflows.  Costs that lie on the grid, integers among them, are solved exactly; otherwise the
// duals are optimal to about 2^-40 of the largest cost.

namespace nda::lap {
namespace {

using Graph = lemon::SmartDigraph;
using Simplex = lemon::NetworkSimplex<Graph, int, std::int64_t>;

// Costs as multiples of a power of two.
class Grid {
 public:
  Grid(std::size_t num_nodes, double largest) {
    const int bits = 59 - static_cast<int>(std::bit_width(num_nodes));
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

double largest_cost(std::span<const FlowNode> rows,
                    std::span<const FlowNode> columns,
                    std::span<const FlowEdge> edges) {
  double largest = 0;
  const auto note = [&](double x) {
    if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
  };
  for (const FlowNode& row : rows) note(row.single);
  for (const FlowNode& column : columns) note(column.single);
  for (const FlowEdge& edge : edges) note(edge.cost);
  return largest;
}

class Network {
 public:
  Network(std::span<const FlowNode> rows,
          std::span<const FlowNode> columns,
          std::span<const FlowEdge> edges);

  FlowAnswer solve();

 private:
  Graph::Arc add_arc(Graph::Node from, Graph::Node to, double c, Index most) {
    if (c == kInfinity || most == 0) return lemon::INVALID;
    const Graph::Arc arc = graph_.addArc(from, to);
    cost_[arc] = grid_.round(c);
    most_[arc] = static_cast<int>(most);
    return arc;
  }

  Grid grid_;
  Graph graph_;
  std::vector<Graph::Node> rows_;
  std::vector<Graph::Node> columns_;
  Graph::Node dummy_;
  std::vector<Graph::Arc> edges_;  // INVALID where forbidden
  Graph::ArcMap<std::int64_t> cost_;
  Graph::ArcMap<int> most_;
  Graph::NodeMap<int> supply_;
};

Network::Network(std::span<const FlowNode> rows,
                 std::span<const FlowNode> columns,
                 std::span<const FlowEdge> edges)
    : grid_(rows.size() + columns.size() + 2, largest_cost(rows, columns, edges)),
      cost_(graph_),
      most_(graph_),
      supply_(graph_, 0) {
  graph_.reserveNode(static_cast<int>(rows.size() + columns.size() + 1));
  graph_.reserveArc(static_cast<int>(edges.size() + 2 * (rows.size() + columns.size())));
  for (std::size_t i = 0; i < rows.size(); ++i) rows_.push_back(graph_.addNode());
  for (std::size_t j = 0; j < columns.size(); ++j) columns_.push_back(graph_.addNode());
  dummy_ = graph_.addNode();
  for (const FlowEdge& edge : edges) {
    const Graph::Node from = edge.row == FlowEdge::kOutside ? dummy_ : rows_[edge.row];
    const Graph::Node to = edge.column == FlowEdge::kOutside ? dummy_ : columns_[edge.column];
    edges_.push_back(add_arc(from, to, edge.cost, edge.most));
  }
  int balance = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    supply_[rows_[i]] = static_cast<int>(rows[i].lo);
    balance -= static_cast<int>(rows[i].lo);
    add_arc(rows_[i], dummy_, rows[i].single, rows[i].lo);
    add_arc(dummy_, rows_[i], 0, rows[i].hi - rows[i].lo);
  }
  for (std::size_t j = 0; j < columns.size(); ++j) {
    supply_[columns_[j]] = -static_cast<int>(columns[j].lo);
    balance += static_cast<int>(columns[j].lo);
    add_arc(dummy_, columns_[j], columns[j].single, columns[j].lo);
    add_arc(columns_[j], dummy_, 0, columns[j].hi - columns[j].lo);
  }
  supply_[dummy_] = balance;
}

// The potential of the dummy node is the zero of the duals.
FlowAnswer Network::solve() {
  Simplex simplex(graph_);
  simplex.supplyMap(supply_).costMap(cost_).upperMap(most_);
  FlowAnswer answer;
  answer.exact = grid_.exact();
  answer.feasible = simplex.run() == Simplex::OPTIMAL;
  if (!answer.feasible) return answer;
  const std::int64_t zero = simplex.potential(dummy_);
  for (const Graph::Node row : rows_)
    answer.u.push_back(grid_.value(zero - simplex.potential(row)));
  for (const Graph::Node column : columns_)
    answer.v.push_back(grid_.value(simplex.potential(column) - zero));
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    if (edges_[e] != lemon::INVALID && simplex.flow(edges_[e]) > 0) answer.chosen.push_back(e);
  }
  return answer;
}

}  // namespace

FlowAnswer solve_flow(std::span<const FlowNode> rows,
                      std::span<const FlowNode> columns,
                      std::span<const FlowEdge> edges) {
  return Network(rows, columns, edges).solve();
}

}  // namespace nda::lap
