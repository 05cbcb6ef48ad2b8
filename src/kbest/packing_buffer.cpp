#include "kbest/packing_buffer.hpp"

#include <algorithm>
#include <utility>

namespace nda::kbest {

// The same arcs have the same cost to the last bit, as make_packing() adds in their order.
bool PackingBuffer::add(core::Packing packing) {
  if (packing.cost >= cutoff()) return false;
  const auto cheaper = [](const core::Packing& a, const core::Packing& b) {
    return a.cost < b.cost;
  };
  const auto [first, last] = std::equal_range(packings_.begin(), packings_.end(), packing, cheaper);
  const auto is_same = [&](const core::Packing& other) { return other.arcs == packing.arcs; };
  if (std::any_of(first, last, is_same)) return false;
  packings_.insert(last, std::move(packing));
  if (packings_.size() > k_) packings_.pop_back();
  return true;
}

}  // namespace nda::kbest
