#include "cutting/tree_search.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

// Depth first is what a small tree wants: the linear program goes on where the parent left it, the
// cuts of a node serve its neighbours.  A large one has time for what makes it fit for several
// threads: the nodes where a search broke off become the roots of searches of their own.  They go
// out in rounds: all of a round know the packings of the rounds before, none those of each other,
// and where each breaks off is counted in work, not in seconds.  Taking the open nodes of least
// bound first is what raises the bound of the whole tree (best first with dives, as in Achterberg,
// Constraint Integer Programming, 2007); the rounds are ours.

namespace nda::cutting {
namespace {

using core::Packing;

constexpr std::size_t kMostAtOnce = 8;
constexpr std::size_t kMostBases = 64;
// So many nodes are no limit to a search of a round.
constexpr std::int64_t kManyNodes = 100000;

// A linear program to go on from, and how many steps down the tree it stands.
struct Base {
  Master master;
  std::size_t steps;
};

// What one search of a round found.
struct Branch {
  std::shared_ptr<Base> base;
  BranchAndCutResult result;
  std::vector<Packing> packings;
};

// How much of one is done at most.
struct Effort {
  std::int64_t nodes;
  double work;
};

// A search whose steps are to stand in the proof: the place of its root.
struct ProofPlace {
  std::size_t parent;  // search, 0 = the first one
  std::size_t size;    // of the parent's log
  std::size_t order;   // among the nodes that the parent left open
};

struct Open {
  OpenNode node;
  ProofPlace place;
  std::shared_ptr<const Base> base;  // null = the first linear program
};

class TreeSearch {
 public:
  TreeSearch(const core::Component& component,
             Master& master,
             double cutoff,
             const BranchAndCutLimits& limits,
             const PackingOffer& offer,
             const TreeShape& shape)
      : component_(component),
        master_(master),
        cutoff_(cutoff),
        limits_(limits),
        offer_(offer),
        shape_(shape) {}

  BranchAndCutResult run() {
    BranchAndCut first(
        component_, master_, cutoff_, limits_, [&](const Master& point, const Packing* found) {
          return cutoff_ = offer_(point, found);
        });
    result_ = first.run({}, 0, shape_.first_work);
    if (result_.open.empty()) return result_;
    leave_open(result_.open, 0, nullptr);
    sort_open();
    while (!open_.empty() && !stopped()) round();
    return finish();
  }

 private:
  bool stopped() const { return left_nodes() <= 0 || limits_.context.deadline.reached(); }
  std::int64_t left_nodes() const { return limits_.max_nodes - result_.nodes; }

  void leave_open(std::vector<OpenNode>& nodes,
                  std::size_t search,
                  const std::shared_ptr<const Base>& base) {
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const ProofPlace place{search, nodes[n].proof_size, n};
      open_.push_back({std::move(nodes[n]), place, base});
    }
    nodes.clear();
  }

  // By what is proven for them.
  void sort_open() {
    std::stable_sort(open_.begin(), open_.end(), [](const Open& a, const Open& b) {
      return a.node.lower < b.node.lower;
    });
  }

  void round() {
    if (limits_.pause) cutoff_ = limits_.pause(result_.nodes, result_.work);
    if (cutoff_ == -kInfinity) return open_.clear();
    const std::vector<Open> chosen = choose();
    const std::int64_t nodes = left_nodes() / static_cast<std::int64_t>(chosen.size());
    // Where few nodes are open, there should soon be more.
    const double share = static_cast<double>(chosen.size()) / static_cast<double>(kMostAtOnce);
    const Effort effort = {nodes, share * shape_.round_work};
    const std::size_t first = places_.size() + 1;
    for (const Open& open : chosen) {
      places_.push_back(open.place);
      if (limits_.context.proof != nullptr) logs_.push_back(limits_.context.proof->fork());
    }
    std::vector<Branch> branches(chosen.size());
    limits_.context.for_all(chosen.size(), [&](std::size_t i) {
      branches[i] = search(chosen[i], effort, log(first + i));
    });
    for (std::size_t i = 0; i < chosen.size(); ++i) take(branches[i], first + i);
    sort_open();
    drop_bases();
  }

  // The first of the open ones; no more than nodes are left for.
  std::vector<Open> choose() {
    const std::int64_t most = std::max<std::int64_t>(1, left_nodes() / kManyNodes);
    const std::size_t count = std::min({open_.size(), kMostAtOnce, static_cast<std::size_t>(most)});
    const auto end = open_.begin() + static_cast<std::ptrdiff_t>(count);
    std::vector<Open> chosen(std::make_move_iterator(open_.begin()), std::make_move_iterator(end));
    open_.erase(open_.begin(), end);
    return chosen;
  }

  // Explores a node with a linear program of its own.
  Branch search(const Open& open, const Effort& effort, bnb::ProofLog* log) const {
    Branch branch;
    branch.base = std::make_shared<Base>(open.base ? *open.base : Base{master_, 0});
    BranchAndCutLimits limits = limits_;
    limits.max_nodes = effort.nodes;
    limits.context.proof = log;
    limits.pause = nullptr;
    double cutoff = cutoff_;
    const PackingOffer offer = [&](const Master&, const Packing* found) {
      if (found != nullptr && found->cost - limits_.margin < cutoff) {
        cutoff = found->cost - limits_.margin;
        branch.packings.push_back(*found);
      }
      return cutoff;
    };
    BranchAndCut tree(component_, branch.base->master, cutoff, limits, offer);
    branch.result = tree.run(open.node, branch.base->steps, effort.work);
    branch.base->steps = open.node.path.size();
    return branch;
  }

  void take(Branch& branch, std::size_t search) {
    for (const Packing& packing : branch.packings)
      cutoff_ = std::min(cutoff_, offer_(master_, &packing));
    result_.lower = std::min(result_.lower, branch.result.lower);
    result_.exhaustive = result_.exhaustive && branch.result.exhaustive;
    result_.nodes += branch.result.nodes;
    result_.tree_nodes += branch.result.tree_nodes;
    result_.work += branch.result.work;
    result_.fixing += branch.result.fixing;
    leave_open(branch.result.open, search, branch.base);
  }

  // They know the cuts of their part of the tree, but take memory: the most promising nodes keep
  // theirs.
  void drop_bases() {
    std::vector<const Base*> kept;
    for (Open& open : open_) {
      if (open.base == nullptr ||
          std::find(kept.begin(), kept.end(), open.base.get()) != kept.end())
        continue;
      if (kept.size() < kMostBases)
        kept.push_back(open.base.get());
      else
        open.base = nullptr;
    }
  }

  BranchAndCutResult finish() {
    for (const Open& open : open_) result_.lower = std::min(result_.lower, open.node.lower);
    result_.exhaustive = result_.exhaustive && open_.empty();
    result_.complete = result_.lower >= cutoff_;
    if (limits_.context.proof != nullptr && result_.exhaustive) graft();
    return result_;
  }

  // The log of a search of a round, they count from 1.
  bnb::ProofLog* log(std::size_t search) {
    return limits_.context.proof == nullptr ? nullptr : &logs_[search - 1];
  }

  // Puts the steps of every search in their place: a search comes after that which left it.
  void graft() {
    std::vector<std::vector<std::size_t>> children(places_.size() + 1);
    for (std::size_t s = 1; s <= places_.size(); ++s) children[places_[s - 1].parent].push_back(s);
    for (std::size_t parent = children.size(); parent-- > 0;) {
      std::sort(
          children[parent].begin(), children[parent].end(), [&](std::size_t a, std::size_t b) {
            return places_[a - 1].order < places_[b - 1].order;
          });
      std::vector<bnb::ProofLog::Graft> grafts;
      for (const std::size_t s : children[parent]) grafts.push_back({places_[s - 1].size, log(s)});
      bnb::ProofLog& log_of_parent = parent == 0 ? *limits_.context.proof : *log(parent);
      if (!grafts.empty()) log_of_parent.graft(grafts);
    }
  }

  const core::Component& component_;
  Master& master_;
  double cutoff_;
  const BranchAndCutLimits& limits_;
  const PackingOffer& offer_;
  const TreeShape shape_;
  std::vector<Open> open_;
  std::vector<ProofPlace> places_;   // of the searches of rounds
  std::vector<bnb::ProofLog> logs_;  // theirs, if a proof is wanted
  BranchAndCutResult result_;
};

}  // namespace

BranchAndCutResult search_tree(const core::Component& component,
                               Master& master,
                               double cutoff,
                               const BranchAndCutLimits& limits,
                               const PackingOffer& offer,
                               const TreeShape& shape) {
  return TreeSearch(component, master, cutoff, limits, offer, shape).run();
}

}  // namespace nda::cutting
