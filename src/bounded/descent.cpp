#include "bounded/descent.hpp"

#include <algorithm>
#include <cmath>

namespace nda::bounded {
namespace {

using core::ArcId;

// Exchanges must gain this share of the costs they move, so that rounding makes no circles.
constexpr double kLeastGain = 1e-11;
constexpr int kMostPasses = 20;
constexpr std::size_t kArcsPerLook = 1024;

class Descent {
 public:
  explicit Descent(const BoundedComponent& component)
      : component_(component),
        graph_(component.graph),
        is_chosen_(component.num_arcs(), false),
        on_(component.rows.size()) {}

  void fill(std::span<const ArcId> order) {
    for (const ArcId a : order) {
      if (fits(a) && change_of_adding(a) < 0) add(a);
    }
  }

  // Whether anything changed.
  bool pass(std::span<const ArcId> order, const core::Deadline& deadline) {
    bool changed = false;
    std::size_t looked_at = 0;
    for (const ArcId a : order) {
      if (looked_at++ % kArcsPerLook == 0 && deadline.reached()) return false;
      changed = (is_chosen_[a] ? leave(a) : enter(a)) || changed;
    }
    return changed;
  }

  std::vector<ArcId> arcs() const {
    std::vector<ArcId> arcs;
    for (ArcId a = 0; a < is_chosen_.size(); ++a) {
      if (is_chosen_[a]) arcs.push_back(a);
    }
    return arcs;
  }

 private:
  const Row& row(std::uint32_t slot) const { return component_.rows[slot]; }
  Index uses(std::uint32_t slot) const { return static_cast<Index>(on_[slot].size()); }

  bool fits(ArcId a) const {
    bool room = true;
    core::for_each_slot(
        graph_, a, [&](std::uint32_t slot) { room = room && uses(slot) < row(slot).hi; });
    return room;
  }

  double change_of_adding(ArcId a) const {
    double change = graph_.costs[a];
    core::for_each_slot(graph_, a, [&](std::uint32_t slot) {
      if (uses(slot) < row(slot).lo) change -= row(slot).single;
    });
    return change;
  }

  double change_of_removing(ArcId a) const {
    double change = -graph_.costs[a];
    core::for_each_slot(graph_, a, [&](std::uint32_t slot) {
      if (uses(slot) <= row(slot).lo) change += row(slot).single;
    });
    return change;
  }

  void add(ArcId a) {
    is_chosen_[a] = true;
    core::for_each_slot(graph_, a, [&](std::uint32_t slot) { on_[slot].push_back(a); });
  }

  void remove(ArcId a) {
    is_chosen_[a] = false;
    core::for_each_slot(graph_, a, [&](std::uint32_t slot) { std::erase(on_[slot], a); });
  }

  static bool gains(double change, double size) { return change < -kLeastGain * size; }

  bool leave(ArcId a) {
    if (!gains(change_of_removing(a), std::abs(graph_.costs[a]))) return false;
    remove(a);
    return true;
  }

  ArcId cheapest_to_remove(std::uint32_t slot) const {
    return *std::min_element(on_[slot].begin(), on_[slot].end(), [&](ArcId a, ArcId b) {
      return change_of_removing(a) < change_of_removing(b);
    });
  }

  bool enter(ArcId a) {
    removed_.clear();
    double change = 0;
    double size = std::abs(graph_.costs[a]);
    bool possible = true;
    core::for_each_slot(graph_, a, [&](std::uint32_t slot) {
      if (uses(slot) < row(slot).hi) return;
      possible = possible && row(slot).hi > 0;
      if (!possible) return;
      const ArcId out = cheapest_to_remove(slot);
      change += change_of_removing(out);
      size += std::abs(graph_.costs[out]);
      remove(out);
      removed_.push_back(out);
    });
    if (possible && gains(change + change_of_adding(a), size)) {
      add(a);
      return true;
    }
    for (const ArcId out : removed_) add(out);
    return false;
  }

  const BoundedComponent& component_;
  const core::Component& graph_;
  std::vector<bool> is_chosen_;         // [arc]
  std::vector<std::vector<ArcId>> on_;  // [slot]: chosen arcs
  std::vector<ArcId> removed_;
};

}  // namespace

Choice greedy_descent(const BoundedComponent& component,
                      std::span<const ArcId> order,
                      const core::Deadline& deadline) {
  Descent descent(component);
  descent.fill(order);
  for (int n = 0; n < kMostPasses && descent.pass(order, deadline); ++n) continue;
  return make_choice(component, descent.arcs());
}

}  // namespace nda::bounded
