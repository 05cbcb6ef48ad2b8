#include "assign2d/cycle_search.hpp"

#include <algorithm>

// Taking a pair from an optimal assignment leaves a row and a column in want; the cheapest repair
// is a shortest path from the row to the column in the residual graph, on reduced costs that are
// not negative.  With every row drawn together with its column this is a cycle.

namespace nda::lap {

void CycleSearch::resize(std::uint32_t num_members) {
  distance_.assign(num_members + 1, kInfinity);
  from_.resize(num_members + 1);
  by_.resize(num_members + 1);
  reached_.clear();
  heap_.resize(num_members + 1);
}

void CycleSearch::forget() {
  for (const std::uint32_t node : reached_) distance_[node] = kInfinity;
  reached_.clear();
  heap_.clear();
}

void CycleSearch::reach(std::uint32_t node,
                        double distance,
                        std::uint32_t from,
                        const Exchange* by) {
  if (!(distance < length_) || !(distance < distance_[node])) return;
  if (distance > limit_) {
    beyond_ = std::min(beyond_, distance);
    return;
  }
  if (distance_[node] == kInfinity) reached_.push_back(node);
  distance_[node] = distance;
  from_[node] = from;
  by_[node] = by;
  heap_.push_or_decrease(node, distance);
}

void CycleSearch::scan(const ExchangeGraph& graph,
                       std::uint32_t node,
                       std::uint32_t source,
                       double distance) {
  if (node == graph.outside()) {
    for (std::uint32_t to = source; to < graph.outside(); ++to) {
      reach(to, distance + graph.members[to].drop, node, nullptr);
    }
    return;
  }
  for (const Exchange& exchange : graph.of(node)) {
    if (exchange.target < source) continue;
    reach(exchange.target, distance + exchange.loss, node, &exchange);
  }
}

CycleSearch::Outcome CycleSearch::search(const ExchangeGraph& graph,
                                         std::uint32_t source,
                                         double limit) {
  forget();
  limit_ = limit;
  length_ = kInfinity;
  beyond_ = kInfinity;
  // An unassigned row has what outside has for all: who takes it goes outside.
  scan(graph, source, source, 0);
  while (!heap_.empty()) {
    const std::uint32_t node = heap_.pop();
    if (node == source) {
      length_ = distance_[node];
      return {true, length_};
    }
    scan(graph, node, source, distance_[node]);
  }
  return {false, beyond_};
}

}  // namespace nda::lap
