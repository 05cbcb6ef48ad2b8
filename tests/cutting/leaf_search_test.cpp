#include "cutting/leaf_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "cutting/cutting_support.hpp"

namespace nda::cutting {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;

const core::Deadline kNever;

// A component, a solved master, and what its searches find.
class Node {
 public:
  explicit Node(std::uint64_t seed)
      : component_(fractional_component(seed)),
        master_(component_, all_arcs(component_), no_multipliers(component_)) {}

  // A random arc's first two indices go together, or do not.
  void branch(core::Random& random) {
    std::vector<std::uint32_t> slots;
    while (slots.size() < 2) {
      slots.clear();
      const auto arc = static_cast<ArcId>(random.below(component_.num_arcs()));
      core::for_each_slot(component_, arc, [&](std::uint32_t slot) { slots.push_back(slot); });
    }
    const bool together = random.below(2) == 0;
    std::vector<ArcId> out;
    for (ArcId a = 0; a < component_.num_arcs(); ++a) {
      const int uses = uses_of(a, slots[0]) + uses_of(a, slots[1]);
      if (uses == (together ? 1 : 2)) out.push_back(a);
    }
    master_.forbid(out);
    if (together) master_.force(slots[0]);
  }

  double best() const {
    double least = kInfinity;
    for (const Packing& packing : support::all_packings(component_)) {
      const auto excluded = [&](ArcId a) { return master_.forbidden(a); };
      if (std::ranges::any_of(packing.arcs, excluded)) continue;
      if (covers_what_it_must(packing)) least = std::min(least, packing.cost);
    }
    return least;
  }

  bool covers_what_it_must(const Packing& packing) const {
    for (std::uint32_t slot = 0; slot < component_.num_slots(); ++slot) {
      const auto covers = [&](ArcId a) { return uses_of(a, slot) == 1; };
      if (master_.forced(slot) && std::ranges::none_of(packing.arcs, covers)) return false;
    }
    return true;
  }

  // Calls search(leaf, cutoff); returns what the cutoff became, what it did not prove being -inf.
  template <typename Search>
  double run(double cutoff, Search&& search) {
    EXPECT_EQ(master_.solve(kInfinity, kNever), lp::Outcome::kOptimal);
    const PackingOffer offer = [&](const Master&, const Packing* found) {
      EXPECT_EQ(support::packing_fault(component_, *found), "");
      return found->cost - 1e-7;
    };
    LeafLimits limits;
    limits.max_nodes = 1000000;
    LeafSearch leaf(component_, limits, 0, offer);
    leaf.earn(1e6);
    return search(leaf, cutoff) ? cutoff : -kInfinity;
  }

  const Master& master() const { return master_; }

 private:
  int uses_of(ArcId a, std::uint32_t wanted) const {
    int uses = 0;
    core::for_each_slot(component_, a, [&](std::uint32_t slot) { uses += slot == wanted; });
    return uses;
  }

  Component component_;
  Master master_;
};

// Both ways to search, from no packing, from a good one, and below branchings.
TEST(LeafSearch, NeverEndsANodeThatHoldsSomethingCheaper) {
  int num_ended = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    Node node(seed);
    for (std::uint64_t depth = seed % 3; depth > 0; --depth) node.branch(random);
    const double best = node.best();
    const double start = seed % 2 == 0 ? 0.0 : std::min(0.0, best + random.uniform(-1, 2));
    for (const bool cliques : {true, false}) {
      const double cutoff = node.run(start, [&](LeafSearch& leaf, double& limit) {
        return cliques ? leaf.cover(node.master(), limit) : leaf(node.master(), limit);
      });
      ASSERT_LE(cutoff, best + 1e-7);
      num_ended += cutoff > -kInfinity;
    }
  }
  EXPECT_GT(num_ended, 1100);
}

}  // namespace
}  // namespace nda::cutting
