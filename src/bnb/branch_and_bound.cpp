#include "bnb/branch_and_bound.hpp"

#include <algorithm>
#include <numeric>

// Lagrangian branch and bound in the way of Fisher (1981), with two habits from the study of set
// packing: a node is reduced until nothing more follows (fixing at zero and at one, components),
// and it is branched on a row, not on a column.  Splitting inside the tree is what keeps it small:
// tracking components fall apart as soon as a few arcs are decided.

namespace nda::bnb {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;

constexpr std::uint32_t kNone = ~std::uint32_t{0};
// A part that keeps more than this share of its node's arcs is branched on without being bounded
// again.
constexpr double kWholeShare = 0.8;

double sum(std::span<const double> u) {
  return std::accumulate(u.begin(), u.end(), 0.0);
}

Packing to_original(const Component& component, const Packing& packing) {
  Packing original = packing;
  for (ArcId& a : original.arcs) a = core::original_arc(component, a);
  return original;
}

void append(Packing& packing, const Packing& more) {
  packing.arcs.insert(packing.arcs.end(), more.arcs.begin(), more.arcs.end());
  packing.cost += more.cost;
}

// What the search may miss: packings less than `skipped` better than the best are not looked for,
// so that the best is proven to be within `missed` of the optimum.
struct Slack {
  double skipped;
  double missed;
};

// One use of the branching index: an arc, or none (kNone), and what it costs in penalty.
struct Use {
  double penalty;
  ArcId arc;
};

class BranchAndBound {
 public:
  BranchAndBound(const Collaborators& collaborators, const BranchLimits& limits)
      : collaborators_(collaborators), limits_(limits), log_(limits.proof) {}

  SearchResult run(const Component& component, std::span<const double> warm, double cutoff) {
    const bool coarse = limits_.gap > limits_.margin;
    return solve(component, warm, cutoff, coarse ? Slack{limits_.gap, limits_.gap} : exact());
  }

  std::int64_t nodes() const { return nodes_; }
  const FixingYield& searches() const { return searches_; }
  const FixingYield& branching() const { return branching_; }

 private:
  Slack exact() const { return {limits_.margin, limits_.error}; }

  SearchResult solve(const Component& component,
                     std::span<const double> warm,
                     double cutoff,
                     const Slack& slack) {
    ++depth_;
    SearchResult result = explore(component, warm, cutoff, slack);
    --depth_;
    return result;
  }

  SearchResult explore(const Component& component,
                       std::span<const double> warm,
                       double cutoff,
                       const Slack& slack) {
    if (component.num_arcs() == 0) return empty_component(component, cutoff);
    if (stopped() || depth_ > kMostProofBranchings) return leave_open(component, warm);
    if (component.num_arcs() <= limits_.enumeration_arcs) {
      SearchResult small = enumerate_part(component, warm, cutoff, slack);
      if (small.complete || stopped()) return small;
    }
    SearchResult result;
    ++nodes_;
    const NodeBound bound = collaborators_.bound(component, warm, cutoff);
    if (bound.packing.cost < cutoff)
      accept(result, to_original(component, bound.packing), cutoff, slack);
    const bool reached = bound.lower >= cutoff;
    if (reached || limits_.deadline.reached()) {
      log_.bound(component, bound.u);
      return finish(result, cutoff, reached ? kInfinity : bound.lower, slack);
    }
    const Reduction reduction = collaborators_.reduce(component, bound, cutoff);
    count(component.num_arcs(), reduction);
    const bool whole = reduction.taken.arcs.empty() && reduction.parts.size() == 1 &&
                       static_cast<double>(reduction.parts[0].num_arcs()) >
                           kWholeShare * static_cast<double>(component.num_arcs());
    log_.fix(component, bound.u, cutoff, reduction.forced);
    SearchResult rest = whole ? branch(reduction.parts[0], reduction.u[0], cutoff, slack)
                              : solve_parts(component, bound, reduction, cutoff, slack);
    if (rest.found) accept(result, std::move(rest.best), cutoff, slack);
    return finish(result, cutoff, rest.complete ? kInfinity : rest.lower, slack);
  }

  void count(std::size_t num_arcs, const Reduction& reduction) {
    std::size_t left = 0;
    for (const Component& part : reduction.parts) left += part.num_arcs();
    const std::size_t taken = reduction.taken.arcs.size();
    branching_.dropped += num_arcs - left - taken;
    branching_.taken += taken;
    if (reduction.parts.size() < 2) return;
    ++branching_.splits;
    branching_.parts += reduction.parts.size();
  }

  bool stopped() const { return nodes_ >= limits_.max_nodes || limits_.deadline.reached(); }

  SearchResult leave_open(const Component& component, std::span<const double> u) {
    log_.bound(component, u);
    SearchResult result;
    result.lower = sum(u);
    return result;
  }

  SearchResult empty_component(const Component& component, double cutoff) {
    log_.bound(component, {});
    SearchResult result;
    result.complete = true;
    result.found = 0 < cutoff;
    result.lower = std::min(0.0, cutoff);
    return result;
  }

  SearchResult enumerate_part(const Component& component,
                              std::span<const double> u,
                              double cutoff,
                              const Slack& slack) {
    const std::int64_t limit = std::min(limits_.enumeration_nodes, limits_.max_nodes - nodes_);
    SearchResult result = enumerate(component, u, cutoff, limit, limits_.deadline);
    nodes_ += result.nodes;
    searches_ += result.searches;
    if (result.found) {
      result.best = to_original(component, result.best);
      if (result.complete) result.lower = result.best.cost - slack.missed;
    }
    const double threshold = result.found ? result.best.cost - slack.skipped : cutoff;
    if (result.complete) {
      log_.search(component, u, threshold);
    } else if (stopped()) {
      log_.bound(component, u);
    }
    return result;
  }

  static void accept(SearchResult& result, Packing packing, double& cutoff, const Slack& slack) {
    result.found = true;
    result.best = std::move(packing);
    cutoff = result.best.cost - slack.skipped;
  }

  // open: least lower bound of what was left unexplored, +inf if nothing.
  static SearchResult finish(SearchResult& result, double cutoff, double open, const Slack& slack) {
    result.complete = open == kInfinity || open >= cutoff;
    const double proven = result.found ? result.best.cost - slack.missed : cutoff;
    result.lower = result.complete ? proven : std::min(proven, open);
    return std::move(result);
  }

  // Parts are independent: each is searched below what the bounds of the others leave of the
  // cutoff.  What the parts miss adds up, so they are searched exactly.
  SearchResult solve_parts(const Component& component,
                           const NodeBound& bound,
                           const Reduction& reduction,
                           double cutoff,
                           const Slack& slack) {
    const std::size_t num_parts = reduction.parts.size();
    std::vector<double> lower;
    for (const std::vector<double>& u : reduction.u) lower.push_back(sum(u));
    double total = std::accumulate(lower.begin(), lower.end(), reduction.taken.cost);
    std::vector<std::size_t> order(num_parts);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return reduction.parts[a].num_arcs() < reduction.parts[b].num_arcs();
    });

    SearchResult result;
    Packing packing = reduction.taken;
    bool all_found = true;
    bool all_complete = true;
    bool too_dear = false;
    std::vector<const Component*> in_order;
    for (const std::size_t p : order) in_order.push_back(&reduction.parts[p]);
    log_.split(in_order);
    for (const std::size_t p : order) {
      too_dear = too_dear || total >= cutoff;
      const double budget = cutoff - (total - lower[p]);
      const SearchResult part = solve_part(reduction.parts[p], reduction.u[p], budget, too_dear);
      too_dear = too_dear || (part.complete && !part.found);
      if (too_dear) continue;
      const double proven = std::max(lower[p], std::min(part.lower, budget));
      total += proven - lower[p];
      lower[p] = proven;
      all_complete = all_complete && part.complete;
      all_found = all_found && part.found;
      if (part.found) append(packing, part.best);
    }
    log_.rest(component, bound.u, reduction.forced, in_order);
    if (too_dear) return finish(result, cutoff, kInfinity, slack);
    if (all_found && packing.cost < cutoff) accept(result, std::move(packing), cutoff, slack);
    return finish(result, cutoff, all_complete ? kInfinity : total, slack);
  }

  SearchResult solve_part(const Component& part,
                          std::span<const double> u,
                          double budget,
                          bool too_dear) {
    log_.group(part);
    SearchResult result = too_dear ? leave_open(part, u) : solve(part, u, budget, exact());
    log_.leave();
    return result;
  }

  SearchResult branch(const Component& component,
                      std::span<const double> u,
                      double cutoff,
                      const Slack& slack) {
    const double lower = sum(u);
    SearchResult result;
    double open = kInfinity;
    const std::uint32_t slot = choose_slot(component, u, cutoff - lower);
    // Without a paying index the packing that takes nothing costs sum u = 0 and is the best.
    if (slot == kNone) {
      log_.bound(component, u);
      if (0 < cutoff) accept(result, Packing{}, cutoff, slack);
      return finish(result, cutoff, kInfinity, slack);
    }
    const std::size_t step = log_.cover(component, slot);
    double least_left = kInfinity;  // penalty of the uses that are not explored
    for (const Use& use : uses_of(component, u, slot)) {
      const bool too_dear = lower + use.penalty >= cutoff;
      if (too_dear || stopped()) {
        least_left = use.penalty;
        if (!too_dear) open = std::min(open, lower + use.penalty);
        break;
      }
      log_use(step, component, slot, use.arc);
      const SearchResult child = solve_child(component, u, slot, use.arc, cutoff, slack);
      log_.leave();
      const double cost = use.arc == kNone ? 0.0 : component.costs[use.arc];
      if (!child.complete) open = std::min(open, std::max(lower + use.penalty, cost + child.lower));
      if (!child.found) continue;
      Packing packing = child.best;
      packing.cost += cost;
      if (use.arc != kNone) packing.arcs.push_back(core::original_arc(component, use.arc));
      if (packing.cost < cutoff) accept(result, std::move(packing), cutoff, slack);
    }
    // Where all uses are explored nothing is left, which costs as much as one likes.
    if (least_left == kInfinity) least_left = std::max(0.0, cutoff - lower);
    log_.others(component, u, slot, least_left);
    return finish(result, cutoff, open, slack);
  }

  void log_use(std::size_t step, const Component& component, std::uint32_t slot, ArcId arc) {
    if (arc == kNone) {
      log_.use_none(step, component, slot);
    } else {
      log_.use(step, component, arc);
    }
  }

  // What is left of the component once `slot` is covered by `arc`, or left uncovered (kNone).
  SearchResult solve_child(const Component& component,
                           std::span<const double> u,
                           std::uint32_t slot,
                           ArcId arc,
                           double cutoff,
                           const Slack& slack) {
    std::vector<bool> covered(component.num_slots(), false);
    covered[slot] = true;
    if (arc != kNone)
      core::for_each_slot(component, arc, [&](std::uint32_t s) { covered[s] = true; });
    std::vector<ArcId> live;
    for (ArcId a = 0; a < component.num_arcs(); ++a) {
      bool hit = false;
      core::for_each_slot(component, a, [&](std::uint32_t s) { hit = hit || covered[s]; });
      if (!hit) live.push_back(a);
    }
    const Component child = cutter_.cut(component, live);
    const std::vector<double> child_u = core::restrict_slots(component, u, child);
    return solve(child, child_u, cutoff - (arc == kNone ? 0.0 : component.costs[arc]), slack);
  }

  static std::vector<Use> uses_of(const Component& component,
                                  std::span<const double> u,
                                  std::uint32_t slot) {
    std::vector<Use> uses = {{-u[slot], kNone}};
    for (ArcId a = 0; a < component.num_arcs(); ++a) {
      bool on_slot = false;
      core::for_each_slot(component, a, [&](std::uint32_t s) { on_slot = on_slot || s == slot; });
      if (on_slot) uses.push_back({std::max(0.0, core::reduced_cost(component, u, a)), a});
    }
    std::stable_sort(
        uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.penalty < b.penalty; });
    return uses;
  }

  // The index with u < 0 and the fewest uses affordable within `slack`.
  static std::uint32_t choose_slot(const Component& component,
                                   std::span<const double> u,
                                   double slack) {
    std::vector<std::uint32_t> uses(component.num_slots(), 0);
    for (ArcId a = 0; a < component.num_arcs(); ++a) {
      if (core::reduced_cost(component, u, a) >= slack) continue;
      core::for_each_slot(component, a, [&](std::uint32_t s) { ++uses[s]; });
    }
    std::uint32_t best = kNone;
    for (std::uint32_t s = 0; s < uses.size(); ++s) {
      if (u[s] >= 0) continue;
      uses[s] += -u[s] < slack ? 1 : 0;
      if (best == kNone || uses[s] < uses[best] || (uses[s] == uses[best] && u[s] < u[best]))
        best = s;
    }
    return best;
  }

  const Collaborators& collaborators_;
  const BranchLimits& limits_;
  TreeLog log_;
  core::Cutter cutter_;
  std::int64_t nodes_ = 0;
  FixingYield searches_;  // of enumerations
  FixingYield branching_;
  int depth_ = 0;  // of the node at hand
};

}  // namespace

SearchResult branch_and_bound(const Component& component,
                              std::span<const double> u,
                              double cutoff,
                              const Collaborators& collaborators,
                              const BranchLimits& limits) {
  BranchAndBound search(collaborators, limits);
  SearchResult result = search.run(component, u, cutoff);
  result.nodes = search.nodes();
  result.searches = search.searches();
  result.branching = search.branching();
  return result;
}

}  // namespace nda::bnb
