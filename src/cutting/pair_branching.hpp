#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "cutting/master.hpp"

namespace nda::cutting {

/// Branching on pairs of rows (Ryan & Foster 1981): in one child one arc uses both, in the other
/// none does.  Every packing is in just one of the two, and a fractional point in neither for some
/// pair.
class PairBranching {
 public:
  /// Keeps references.
  PairBranching(const core::Component& component, Master& master, const core::Deadline& deadline)
      : component_(component), master_(master), deadline_(deadline) {}

  struct Pair {
    std::uint32_t first;
    std::uint32_t second;
    double weight;  // sum of x over the arcs that use both slots
  };
  struct Choice {
    Pair pair;
    double together;  // bounds of the children, as far as a trial tells
    double apart;
  };

  /// One step down the tree: the pair, and which child.
  struct Step {
    Pair pair;
    bool is_together;
  };

  /// The pairs that the last point of the master uses together, but neither always nor never.
  std::vector<Pair> fractional_pairs() const;
  /// The pairs of slots that not all packings left use alike, those that the last point uses
  /// together where it has any.
  std::vector<Pair> open_pairs() const;
  /// The pair whose children promise most.  @param pairs  not empty.
  Choice choose(std::vector<Pair> pairs, double cutoff);

  /// Goes one step down for good.
  void descend(const Step& step);

  /// Calls visit() while one arc must use both.
  template <typename Visit>
  void together(const Pair& pair, Visit&& visit) {
    const std::vector<core::ArcId> one = arcs_of_one(pair);
    master_.forbid(one);
    master_.force(pair.first);
    std::forward<Visit>(visit)();
    master_.release(pair.first);
    master_.allow(one);
  }
  /// Calls visit() while no arc uses both.
  template <typename Visit>
  void apart(const Pair& pair, Visit&& visit) {
    const std::vector<core::ArcId> both = arcs_of_both(pair);
    master_.forbid(both);
    std::forward<Visit>(visit)();
    master_.allow(both);
  }

 private:
  bool uses(core::ArcId a, std::uint32_t slot) const;
  bool is_open(const Pair& pair) const;
  void add_open_pairs(core::ArcId a, double weight, std::vector<Pair>& pairs) const;
  std::vector<core::ArcId> arcs_of_one(const Pair& pair) const;
  std::vector<core::ArcId> arcs_of_both(const Pair& pair) const;

  const core::Component& component_;
  Master& master_;
  const core::Deadline& deadline_;
};

}  // namespace nda::cutting
