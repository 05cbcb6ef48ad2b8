#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

#include "nda/types.hpp"

namespace nda {

/// An N-dimensional assignment problem, immutable once built.
///
/// Index sets (dimensions) k = 0..N-1 hold the real indices 1..M_k; index 0 is the reusable dummy.
/// An arc is a tuple (i_0..i_{N-1}) with a cost.  Minimise the total cost of the chosen arcs so
/// that every real index is used by exactly one of them.  An arc with one real index is a
/// *singleton* (false alarm, missed track); every index has one, of cost 0 unless set, +inf where
/// forbidden.
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

  /// Arcs of two or more real indices added so far.
  std::size_t num_arcs() const { return problem_.costs_.size(); }
  std::span<const Index> sizes() const { return problem_.sizes_; }

  /// Sorts, removes duplicates, and gives the problem away.  O(A N + sum of M_k).  Afterwards the
  /// builder holds nothing, and add_arc() and build() throw InputError.
  Problem build() &&;

 private:
  Problem problem_;
  std::vector<std::vector<bool>> singleton_given_;
};

}  // namespace nda
