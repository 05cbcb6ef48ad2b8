#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "recovery/rivals.hpp"

namespace nda::recovery {

/// A packing under change that knows what every arc would gain: its value less those of the members
/// that would have to leave for it.
///
/// Inserting or removing an arc is O(its rivals), asking for a gain O(1).
class GainPacking {
 public:
  /// Gains come in whole blocks, so that the processor's vector unit takes several at once.
  static constexpr std::size_t kBlock = 64;

  /// Keeps a reference.
  explicit GainPacking(const Rivals& rivals) : rivals_(rivals) { clear(); }

  void clear();
  void assign(std::span<const std::uint32_t> members);
  bool contains(std::uint32_t n) const { return is_member_[n] != 0; }
  /// It is no member and no member excludes it.
  bool fits(std::uint32_t n) const;
  /// It must fit.
  void insert(std::uint32_t n);
  /// It must be a member.
  void remove(std::uint32_t n);

  const Rivals& rivals() const { return rivals_; }
  /// In any order.
  const std::vector<std::uint32_t>& members() const { return members_; }
  /// Value of the members.
  double total() const { return total_; }
  /// -inf for members.
  double gain(std::uint32_t n) const { return gain_[n]; }
  /// In whole blocks, -inf beyond the arcs.
  const std::vector<double>& gains() const { return gain_; }
  /// Of changes since the last call, in the units of bnb::SlackLimits.
  double take_work() { return std::exchange(work_, 0.0); }

 private:
  const Rivals& rivals_;
  std::vector<double> gain_;
  std::vector<char> is_member_;
  std::vector<std::uint32_t> members_;
  std::vector<std::uint32_t> place_;  // of a member in members_
  double total_ = 0;
  double work_ = 0;
};

}  // namespace nda::recovery
