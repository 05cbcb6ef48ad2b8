#include "kbest/packing_buffer.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

// Additions are many and looks at all of them in order few: what is new waits in a heap, which
// knows the last one, until somebody looks.  What is found in order needs neither.

namespace nda::kbest {
namespace {

bool comes_before(const PackingBuffer::Kept& a, const PackingBuffer::Kept& b) {
  return std::tie(a.cost, a.number) < std::tie(b.cost, b.number);
}

}  // namespace

// The same arcs have the same cost to the last bit, as make_packing() adds in their order.
bool PackingBuffer::add(core::Packing packing) {
  if (packing.cost >= cutoff()) return false;
  const auto [arcs, is_new] = arcs_.insert(std::move(packing.arcs));
  if (!is_new) return false;
  const Kept kept{packing.cost, num_found_++, &*arcs};
  if (recent_.empty() && (sorted_.empty() || sorted_.back().cost <= kept.cost)) {
    sorted_.push_back(kept);
  } else {
    recent_.push_back(kept);
    std::push_heap(recent_.begin(), recent_.end(), comes_before);
  }
  if (size() > k_) drop_last();
  return true;
}

void PackingBuffer::add_best(std::vector<core::Packing> packings, const core::Deadline& deadline) {
  for (std::size_t n = 0; n < packings.size() && (n < kFewPackings || !deadline.reached()); ++n)
    add(std::move(packings[n]));
}

void PackingBuffer::resize(std::size_t k) {
  k_ = k;
  while (size() > k_) drop_last();
}

const std::vector<PackingBuffer::Kept>& PackingBuffer::packings() {
  const auto num_sorted = static_cast<std::ptrdiff_t>(sorted_.size());
  std::sort(recent_.begin(), recent_.end(), comes_before);
  sorted_.insert(sorted_.end(), recent_.begin(), recent_.end());
  std::inplace_merge(sorted_.begin(), sorted_.begin() + num_sorted, sorted_.end(), comes_before);
  recent_.clear();
  return sorted_;
}

std::vector<core::Packing> PackingBuffer::take(const core::Deadline& deadline) {
  std::vector<core::Packing> taken;
  for (const Kept& kept : packings()) {
    if (taken.size() >= kFewPackings && deadline.reached()) break;
    taken.push_back({std::move(arcs_.extract(*kept.arcs).value()), kept.cost});
  }
  sorted_.clear();
  arcs_.clear();
  return taken;
}

bool PackingBuffer::is_last_recent() const {
  return sorted_.empty() || (!recent_.empty() && comes_before(sorted_.back(), recent_.front()));
}

void PackingBuffer::drop_last() {
  arcs_.erase(arcs_.find(*last().arcs));
  if (is_last_recent()) {
    std::pop_heap(recent_.begin(), recent_.end(), comes_before);
    recent_.pop_back();
  } else {
    sorted_.pop_back();
  }
}

}  // namespace nda::kbest
