#pragma once

#include "core/component.hpp"
#include "cutting/branch_and_cut.hpp"
#include "cutting/leaf_search.hpp"
#include "cutting/master.hpp"

namespace nda::cutting {

/// When a search breaks off and leaves its nodes to rounds: work (bnb::SlackLimits), some 40
/// million a second.
struct TreeShape {
  double first_work = 3e7;
  double round_work = 3e7;  ///< of every search of a round of many; of one of few, a part
};

/// Branch and cut (cutting/branch_and_cut.hpp) of a tree that may be large: depth first at first,
/// then in rounds of open nodes, those of the least bound, each explored depth first for a while
/// with a linear program of its own.  What a round explores depends on the rounds before it alone,
/// so the answer does not depend on how many of its nodes `limits.context.for_all` explores at
/// once.
BranchAndCutResult search_tree(const core::Component& component,
                               Master& master,
                               double cutoff,
                               const BranchAndCutLimits& limits,
                               const PackingOffer& offer,
                               const TreeShape& shape = {});

}  // namespace nda::cutting
