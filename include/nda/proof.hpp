#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nda/problem.hpp"
#include "nda/types.hpp"

namespace nda {

/// How far branchings and divisions may stand one below the other, and how deep a search may go:
/// checking either takes stack.
inline constexpr int kMostProofBranchings = 1500;
inline constexpr int kMostProofSearchDepth = 500;

/// A real index: dimension from 0, index from 1.
struct ProofIndex {
  int dimension = 0;
  Index index = 0;
};

/// A Chvatal-Gomory cut of rank 1 and its multiplier: with weights p and a divisor D,
///
///     sum over arcs of floor(sum of p over the arc's indices / D) x_a <= floor(sum of p / D)
///
/// holds for every solution, whatever p >= 0 and D >= 1 are, as no index is used twice.
struct ProofCut {
  std::vector<std::uint32_t> positions;  ///< of its indices in ProofPart::indices; each once
  std::vector<std::uint8_t> weights;     ///< one for each position
  std::uint8_t divisor = 2;              ///< >= 1
  double multiplier = 0;                 ///< <= 0
};

/// A multiplier that changes.
struct ProofMultiplier {
  std::uint32_t position = 0;  ///< in ProofPart::indices
  double value = 0;            ///< finite
};

/// Multipliers y of all indices of a part, and cuts.  Together they bound every choice of allowed
/// arcs and singletons that uses each index exactly once:
///
///     sum y + sum over cuts of multiplier * right side + sum over both of min(0, reduced cost),
///
/// an arc's reduced cost being c - sum of y over its indices - sum of multiplier * coefficient over
/// the cuts, a singleton's s - y (report, Theorem 4.1; the cuts are more rows of the same kind).
struct ProofPoint {
  /// Those that differ from the point before it in the part; before the first all are 0.
  std::vector<ProofMultiplier> changes;
  std::vector<ProofCut> cuts;
};

enum class ProofRule : std::uint8_t {
  kBound,     ///< the point's bound
  kFix,       ///< forbids arcs whose reduced cost lifts the point's bound to the threshold; the
              ///< bound is the least of the threshold and the next step
  kTogether,  ///< two indices are used by one arc (next step) or by two (the step after that part
              ///< of the tree); the bound is the least of both
  kApart,     ///< the same, the other child first
  kSearch,    ///< the checker searches for something cheaper than the threshold, within what the
              ///< point's bound leaves
  kCliques,   ///< the checker searches for something cheaper than the threshold, bounded by arcs
              ///< that exclude each other
  kCover,     ///< an index is used in one of several ways (a child each, in their order), each of
              ///< which does with the indices it takes and adds what it costs, or in none of them
              ///< (one child more); the bound is the least of all
  kSplit,     ///< groups of indices that no allowed arc connects (a child each, in their order),
              ///< and the indices in no group (one child more); the bound is the sum of all, each
              ///< rounded up to the grid
};

/// A step of a proof; which fields count depends on the rule.
struct ProofStep {
  ProofRule rule = ProofRule::kBound;
  ProofPoint point;         ///< of kBound, kFix, kSearch, kCliques
  double threshold = 0;     ///< of kFix, kSearch, kCliques: a cost
  std::uint32_t first = 0;  ///< of kTogether, kApart: positions; of kCover: the index's
  std::uint32_t second = 0;
  std::vector<std::uint32_t> uses =
      {};  ///< of kCover: arcs of the problem, from 1; 0 = it stays alone
  std::vector<std::vector<std::uint32_t>> groups = {};  ///< of kSplit: positions
};

/// Indices that no arc worth using connects with others, and a tree that bounds what they cost.
struct ProofPart {
  std::vector<ProofIndex> indices;
  std::vector<ProofStep> steps;  ///< the tree in preorder
};

/// Why no solution of a problem costs less than a bound.
///
/// An arc that costs no less than the singletons of its indices, all of them allowed, is not worth
/// using: there is an optimal solution without any.  All others must lie within one part each.
/// Indices in no part cost their singletons.
struct Proof {
  std::vector<Index> sizes;  ///< M_k of the problem
  std::size_t num_arcs = 0;  ///< of the problem
  double grid = 0;           ///< all costs are multiples of it but for one rounding; 0 = not known
  std::vector<ProofPart> parts;
};

/// The verdict on a proof.
struct ProofReport {
  double lower_bound = -kInfinity;  ///< what it proves; -inf where it has a fault
  std::string fault;                ///< one sentence; empty when there is none

  bool passed() const { return fault.empty(); }
};

/// Follows a proof with code of its own, which shares the two types and the arithmetic of sums with
/// the solver and nothing else.  Sums are kept in double-double and rounded downwards, so that no
/// rounding is on the proof's side.  Never throws on a wrong proof.  Of a problem with bounds on
/// uses there is none: a fault. Cost: O(A N + cuts) for every step; a kSearch or kCliques takes
/// what it takes, within a limit of work.
ProofReport check_proof(const Problem& problem, const Proof& proof);

}  // namespace nda
