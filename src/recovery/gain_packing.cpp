#include "recovery/gain_packing.hpp"

#include <algorithm>

#include "nda/types.hpp"

// No rival of a member comes or leaves before the member does, so its gain when it has left is its
// value: no sum to keep up meanwhile, and what rounding left in the sum is forgotten.

namespace nda::recovery {
namespace {

constexpr double kWorkPerChange = 0.25;  // of a gain

}  // namespace

void GainPacking::clear() {
  const std::size_t num_blocks = (rivals_.num_arcs() + kBlock - 1) / kBlock;
  gain_.assign(rivals_.values().begin(), rivals_.values().end());
  gain_.resize(num_blocks * kBlock, -kInfinity);
  is_member_.assign(rivals_.num_arcs(), 0);
  place_.assign(rivals_.num_arcs(), 0);
  members_.clear();
  total_ = 0;
}

void GainPacking::assign(std::span<const std::uint32_t> members) {
  clear();
  for (const std::uint32_t n : members) insert(n);
}

bool GainPacking::fits(std::uint32_t n) const {
  const auto rivals = rivals_[n];
  return !contains(n) &&
         std::none_of(rivals.begin(), rivals.end(), [&](auto r) { return contains(r); });
}

void GainPacking::insert(std::uint32_t n) {
  is_member_[n] = 1;
  place_[n] = static_cast<std::uint32_t>(members_.size());
  members_.push_back(n);
  const double value = rivals_.value(n);
  total_ += value;
  gain_[n] = -kInfinity;
  for (const std::uint32_t rival : rivals_[n]) gain_[rival] -= value;
  work_ += kWorkPerChange * static_cast<double>(rivals_[n].size());
}

void GainPacking::remove(std::uint32_t n) {
  is_member_[n] = 0;
  members_[place_[n]] = members_.back();
  place_[members_.back()] = place_[n];
  members_.pop_back();
  const double value = rivals_.value(n);
  total_ -= value;
  gain_[n] = value;
  for (const std::uint32_t rival : rivals_[n]) gain_[rival] += value;
  work_ += kWorkPerChange * static_cast<double>(rivals_[n].size());
}

}  // namespace nda::recovery
