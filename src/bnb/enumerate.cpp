#include "bnb/enumerate.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/slices.hpp"

// The report (4.7) leaves small components to branch and bound.  Branching on an index, not on an
// arc, keeps the tree balanced: exactly one use of the index happens, one of its arcs or none. Only
// indices with u < 0 need a decision: leaving any other uncovered is free, and no arc left can pay
// (all r >= 0), so when they are all decided the packing is complete.

namespace nda::bnb {
namespace {

using core::ArcId;
using core::Component;

constexpr std::uint32_t kNone = ~std::uint32_t{0};
constexpr std::size_t kManyArcs = 2000;

class Enumeration {
 public:
  Enumeration(const Component& component,
              std::span<const double> u,
              double cutoff,
              std::int64_t max_nodes,
              const core::Deadline& deadline)
      : component_(component),
        u_(u),
        max_nodes_(max_nodes),
        deadline_(deadline),
        lower_(std::accumulate(u.begin(), u.end(), 0.0)),
        cutoff_(cutoff),
        decided_(component.num_slots(), false) {
    const std::size_t num_arcs = component.num_arcs();
    reduced_.resize(num_arcs);
    for (ArcId a = 0; a < num_arcs; ++a) {
      reduced_[a] = std::max(0.0, core::reduced_cost(component, u, a));
    }
    order_.resize(num_arcs);
    std::iota(order_.begin(), order_.end(), 0u);
    const auto cheaper = [&](ArcId a, ArcId b) {
      return reduced_[a] != reduced_[b] ? reduced_[a] < reduced_[b] : a < b;
    };
    stopped_ = !core::sort_until(deadline, order_, cheaper);
    num_uses_.resize(component.num_slots());
  }

  SearchResult run() {
    std::vector<ArcId> live;
    for (const ArcId a : order_) {
      if (lower_ + reduced_[a] < cutoff_) live.push_back(a);
    }
    descend(live, 0.0);
    result_.nodes = nodes_;
    result_.complete = !stopped_;
    if (result_.found) {
      std::sort(result_.best.arcs.begin(), result_.best.arcs.end());
      result_.best.cost = 0;
      for (const ArcId a : result_.best.arcs) result_.best.cost += component_.costs[a];
    }
    result_.lower = stopped_ ? std::min(lower_, cutoff_) : cutoff_;
    return result_;
  }

 private:
  // Every few hundred thousand arcs looked at.
  bool is_time_to_look(const std::vector<ArcId>& live) const {
    return nodes_ % 256 == 0 || live.size() > kManyArcs;
  }

  // live: arcs that fit, cheapest first; spent: reduced costs and uncovered indices so far.
  void descend(const std::vector<ArcId>& live, double spent) {
    if (++nodes_ >= max_nodes_ || (is_time_to_look(live) && deadline_.reached())) {
      stopped_ = true;
    }
    if (stopped_) return;
    const std::uint32_t slot = choose_slot(live, spent);
    if (slot == kNone) return accept(spent);
    decided_[slot] = true;
    for (const ArcId a : live) {
      if (!contains(a, slot)) continue;
      if (lower_ + spent + reduced_[a] >= cutoff_ || stopped_) break;
      take(a, live, spent);
    }
    if (lower_ + spent - u_[slot] < cutoff_ && !stopped_) leave(slot, live, spent);
    decided_[slot] = false;
  }

  void take(ArcId a, const std::vector<ArcId>& live, double spent) {
    const double total = spent + reduced_[a];
    std::vector<std::uint32_t> marked;
    core::for_each_slot(component_, a, [&](std::uint32_t s) {
      if (!decided_[s]) marked.push_back(s);
      decided_[s] = true;
    });
    chosen_.push_back(a);
    descend(filter(live, total, [&](ArcId b) { return !disjoint(a, b); }), total);
    chosen_.pop_back();
    for (const std::uint32_t s : marked) decided_[s] = false;
  }

  void leave(std::uint32_t slot, const std::vector<ArcId>& live, double spent) {
    const double total = spent - u_[slot];
    descend(filter(live, total, [&](ArcId b) { return contains(b, slot); }), total);
  }

  template <typename Drop>
  std::vector<ArcId> filter(const std::vector<ArcId>& live, double spent, Drop&& drop) const {
    std::vector<ArcId> rest;
    rest.reserve(live.size());
    for (const ArcId b : live) {
      if (lower_ + spent + reduced_[b] >= cutoff_) break;
      if (!drop(b)) rest.push_back(b);
    }
    return rest;
  }

  // The undecided index with u < 0 and the fewest uses; kNone when none is left.
  std::uint32_t choose_slot(const std::vector<ArcId>& live, double spent) {
    std::fill(num_uses_.begin(), num_uses_.end(), 0u);
    for (const ArcId a : live) {
      core::for_each_slot(component_, a, [&](std::uint32_t s) { ++num_uses_[s]; });
    }
    std::uint32_t best = kNone;
    std::uint32_t fewest = kNone;
    for (std::uint32_t s = 0; s < num_uses_.size(); ++s) {
      if (decided_[s] || u_[s] >= 0) continue;
      const std::uint32_t uses = num_uses_[s] + (lower_ + spent - u_[s] < cutoff_ ? 1 : 0);
      if (uses < fewest) {
        fewest = uses;
        best = s;
      }
    }
    return best;
  }

  void accept(double spent) {
    if (lower_ + spent >= cutoff_) return;
    cutoff_ = lower_ + spent;
    result_.found = true;
    result_.best.arcs = chosen_;
  }

  bool contains(ArcId a, std::uint32_t slot) const {
    bool found = false;
    core::for_each_slot(component_, a, [&](std::uint32_t s) { found = found || s == slot; });
    return found;
  }

  bool disjoint(ArcId a, ArcId b) const {
    for (int k = 0; k < component_.num_dimensions(); ++k) {
      if (component_.index(k, a) != 0 && component_.index(k, a) == component_.index(k, b))
        return false;
    }
    return true;
  }

  const Component& component_;
  const std::span<const double> u_;
  const std::int64_t max_nodes_;
  const core::Deadline& deadline_;
  const double lower_;
  double cutoff_;
  std::vector<double> reduced_;
  std::vector<ArcId> order_;
  std::vector<bool> decided_;
  std::vector<std::uint32_t> num_uses_;
  std::vector<ArcId> chosen_;
  std::int64_t nodes_ = 0;
  bool stopped_ = false;
  SearchResult result_;
};

}  // namespace

SearchResult enumerate(const Component& component,
                       std::span<const double> u,
                       double cutoff,
                       std::int64_t max_nodes,
                       const core::Deadline& deadline) {
  return Enumeration(component, u, cutoff, max_nodes, deadline).run();
}

}  // namespace nda::bnb
