#pragma once

#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "nda/types.hpp"

namespace nda {

/// How often an index must and may be used: lo <= uses <= hi, the singleton's among them.
struct UseBounds {
  /// As hi: no limit.
  static constexpr Index kUnlimited = std::numeric_limits<Index>::max();

  Index lo = 1;
  Index hi = 1;

  bool operator==(const UseBounds&) const = default;
};

/// An N-dimensional assignment problem, immutable once built.
///
/// Index sets (dimensions) k = 0..N-1 hold the real indices 1..M_k; index 0 is the reusable dummy.
/// An arc is a tuple (i_0..i_{N-1}) with a cost.  Minimise the total cost of the chosen arcs so
/// that every real index is used by exactly one of them.  An arc with one real index is a
/// *singleton* (false alarm, missed track); every index has one, of cost 0 unless set, +inf where
/// forbidden.
///
/// *Many-to-one*: an index may have bounds lo..hi instead of 1..1, for merged measurements and
/// split targets.  An arc is chosen at most once, a singleton as often as it takes; every choice of
/// it counts as a use and costs.
///
/// A problem that was moved from has 0 dimensions; solve() and write_problem() then throw
/// InputError.
///
/// Dimensions count from 0 in code and from 1 in files and messages.
/// Source: Poore, AFOSR final report 1995, eq. (2.5) and (3.1).
class Problem {
 public:
  /// N, between 2 and kMaxDimensions; 0 when moved from.
  int num_dimensions() const { return static_cast<int>(sizes_.size()); }

  /// M_k, the number of real indices of dimension k.
  Index size(int k) const { return sizes_[static_cast<std::size_t>(k)]; }
  std::span<const Index> sizes() const { return sizes_; }

  /// Sum of all M_k: the number of covering constraints.
  std::size_t num_indices() const;

  /// Arcs with two or more real indices: distinct tuples, in lexicographic order.
  std::size_t num_arcs() const { return costs_.size(); }

  /// Index i_k of every arc, `num_arcs()` entries.
  std::span<const Index> indices(int k) const { return indices_[static_cast<std::size_t>(k)]; }

  /// Cost of every arc; finite.
  std::span<const double> costs() const { return costs_; }

  /// Cost of leaving index i of dimension k alone: M_k + 1 entries, entry 0 (the dummy) is 0.
  std::span<const double> singleton_costs(int k) const {
    return singleton_costs_[static_cast<std::size_t>(k)];
  }

  /// How often index i of dimension k is to be used: M_k + 1 entries, entry 0 (the dummy) is
  /// 0..unlimited; no entries at all where every index of the dimension is to be used exactly once.
  std::span<const UseBounds> use_bounds(int k) const {
    return use_bounds_[static_cast<std::size_t>(k)];
  }
  /// The same of one index.
  UseBounds use_bounds(int k, Index i) const {
    const std::span<const UseBounds> all = use_bounds(k);
    return all.empty() ? UseBounds{} : all[i];
  }
  /// Whether any index has bounds other than 1..1.
  bool is_many_to_one() const;

  /// The tuple of arc a, N entries.
  std::vector<Index> arc(std::size_t a) const;

  /// The arc with this tuple (N entries), if there is one.  O(N log num_arcs).
  std::optional<std::size_t> find(std::span<const Index> tuple) const;

  /// Arcs that were given more than once (the cheapest was kept), and arcs of infinite cost: both
  /// dropped.
  std::size_t num_duplicates() const { return num_duplicates_; }
  std::size_t num_forbidden() const { return num_forbidden_; }

 private:
  friend class ProblemBuilder;
  Problem() = default;

  std::vector<Index> sizes_;
  std::vector<std::vector<Index>> indices_;  // [dimension][arc]
  std::vector<double> costs_;
  std::vector<std::vector<double>> singleton_costs_;  // [dimension][index]
  std::vector<std::vector<UseBounds>> use_bounds_;    // [dimension][index], or [dimension] empty
  std::size_t num_duplicates_ = 0;
  std::size_t num_forbidden_ = 0;
};

/// Collects arcs and makes a Problem.
///
///     nda::ProblemBuilder builder({2, 2, 2});
///     builder.add_arc({1, 1, 1}, -5.0);
///     builder.add_arc({2, 0, 2}, -3.0);
///     nda::Problem problem = std::move(builder).build();
class ProblemBuilder {
 public:
  /// @param sizes  M_k per dimension, 2 to kMaxDimensions of them.  Throws InputError.
  explicit ProblemBuilder(std::vector<Index> sizes);

  /// Room for `num_arcs` arcs; an optimisation only.
  void reserve(std::size_t num_arcs);

  /// Adds an arc.  A tuple with one real index sets that singleton's cost.  Of equal tuples the
  /// cheapest counts.  Cost +inf forbids.  Throws InputError on a tuple of the wrong length, an
  /// index out of range, a tuple of dummies only, a cost that is NaN or -inf; the builder is then
  /// unchanged.
  void add_arc(std::span<const Index> tuple, double cost);
  void add_arc(std::initializer_list<Index> tuple, double cost) {
    add_arc(std::span<const Index>(tuple.begin(), tuple.size()), cost);
  }

  /// How often index i (>= 1) of dimension k (from 0) is to be used.  The last word counts.
  /// Throws InputError on a dimension or an index out of range, on lo > hi and on an unlimited lo;
  /// the builder is then unchanged.
  void set_use_bounds(int k, Index i, UseBounds bounds);

  /// Arcs of two or more real indices added so far.
  std::size_t num_arcs() const { return problem_.costs_.size(); }
  std::span<const Index> sizes() const { return problem_.sizes_; }

  /// Sorts, removes duplicates, and gives the problem away.  Throws InputError where an unlimited
  /// index has a singleton of negative cost: the problem has no least cost.  O(A N + sum of M_k).
  /// Afterwards the builder holds nothing, and add_arc() and build() throw InputError.
  Problem build() &&;

 private:
  void settle_use_bounds();

  Problem problem_;
  std::vector<std::vector<bool>> singleton_given_;
};

}  // namespace nda
