#pragma once

#include <cstdint>
#include <vector>

#include "assign2d/exchange_graph.hpp"
#include "assign2d/quad_heap.hpp"

namespace nda::lap {

/// The cheapest way to make one member choose again: a shortest cycle through it.
class CycleSearch {
 public:
  struct Outcome {
    bool found;
    double loss;  ///< length of the cycle; if not found: there is none below this
  };

  /// For graphs of so many members.
  void resize(std::uint32_t num_members);

  /// Dijkstra from `source`, whose members before it take no part, up to a length of `limit`.
  /// O(exchanges * log) at worst.
  Outcome search(const ExchangeGraph& graph, std::uint32_t source, double limit);

  /// After a search that found a cycle: the node before `node` on its path, and the exchange from
  /// there (outside has none); for the source that is where the cycle closes.
  std::uint32_t before(std::uint32_t node) const { return from_[node]; }
  const Exchange* exchange_to(std::uint32_t node) const { return by_[node]; }
  /// min(distance, length of the cycle); of the source as the end of the cycle.
  double potential(std::uint32_t node) const {
    return distance_[node] < length_ ? distance_[node] : length_;
  }

 private:
  void forget();
  void reach(std::uint32_t node, double distance, std::uint32_t from, const Exchange* by);
  void scan(const ExchangeGraph& graph, std::uint32_t node, std::uint32_t source, double distance);

  double limit_ = 0;
  double length_ = 0;  // of the shortest cycle so far
  double beyond_ = 0;  // least distance passed over for the limit
  std::vector<double> distance_;
  std::vector<std::uint32_t> from_;
  std::vector<const Exchange*> by_;
  std::vector<std::uint32_t> reached_;
  QuadHeap heap_;
};

}  // namespace nda::lap
