#include "bnb/tree_log.hpp"

// The steps of a proof know fixing at zero only.  Fixing at one is fixing the rivals of an arc a at
// zero, by other multipliers that prove as much.  Let i be the index that only a can still use, and
// j another of a.  Taking u_i from i and giving it to j leaves the sum as it is and the reduced
// cost of a, too; the other arcs of i are dropped already, and those of j now cost -u_i more, which
// is what makes leaving i uncovered too dear.  Forced arcs share no index, so this is done to all
// of them at once, for each of their other indices in turn.

namespace nda::bnb {
namespace {

using core::ArcId;
using core::Component;

std::vector<std::uint32_t> slots_of(const Component& component, ArcId arc) {
  std::vector<std::uint32_t> slots;
  core::for_each_slot(component, arc, [&](std::uint32_t slot) { slots.push_back(slot); });
  return slots;
}

// Moves the multiplier of the index that forces an arc to its n-th other index; false where no arc
// has that many.
bool move_to_others(const Component& component,
                    std::span<const ForcedArc> forced,
                    std::size_t n,
                    std::vector<double>& u) {
  bool any = false;
  for (const auto [arc, slot] : forced) {
    std::vector<std::uint32_t> others = slots_of(component, arc);
    std::erase(others, slot);
    if (n >= others.size()) continue;
    u[others[n]] += u[slot];
    u[slot] = 0;
    any = true;
  }
  return any;
}

}  // namespace

void TreeLog::bound(const Component& component, std::span<const double> u) {
  if (log_ == nullptr) return;
  log_->enter(component);
  log_->bound(u);
}

void TreeLog::search(const Component& component, std::span<const double> u, double threshold) {
  if (log_ == nullptr) return;
  log_->enter(component);
  log_->search(u, threshold);
}

void TreeLog::fix(const Component& component,
                  std::span<const double> u,
                  double threshold,
                  std::span<const ForcedArc> forced) {
  if (log_ == nullptr) return;
  log_->enter(component);
  log_->fix(u, threshold);
  for (std::size_t n = 0;; ++n) {
    std::vector<double> moved(u.begin(), u.end());
    if (!move_to_others(component, forced, n, moved)) return;
    log_->fix(moved, threshold);
  }
}

std::size_t TreeLog::cover(const Component& component, std::uint32_t slot) {
  if (log_ == nullptr) return 0;
  log_->enter(component);
  return log_->cover(slot);
}

void TreeLog::use(std::size_t step, const Component& component, ArcId arc) {
  if (log_ == nullptr) return;
  log_->enter(component);
  log_->use(step, core::original_arc(component, arc) + 1, slots_of(component, arc));
}

void TreeLog::use_none(std::size_t step, const Component& component, std::uint32_t slot) {
  if (log_ == nullptr) return;
  log_->enter(component);
  log_->use(step, 0, {&slot, 1});
}

void TreeLog::others(const Component& component,
                     std::span<const double> u,
                     std::uint32_t slot,
                     double penalty) {
  if (log_ == nullptr) return;
  std::vector<double> raised(u.begin(), u.end());
  raised[slot] += penalty;
  bound(component, raised);
}

void TreeLog::split(std::span<const Component* const> parts) {
  if (log_ != nullptr) log_->split(parts);
}

void TreeLog::group(const Component& part) {
  if (log_ != nullptr) log_->group(part);
}

// Multipliers that make up the cost of every forced arc, and 0 elsewhere.
void TreeLog::rest(const Component& component,
                   std::span<const double> u,
                   std::span<const ForcedArc> forced,
                   std::span<const Component* const> parts) {
  if (log_ == nullptr) return;
  std::vector<double> exact(u.size(), 0.0);
  for (const auto [arc, slot] : forced) {
    for (const std::uint32_t s : slots_of(component, arc)) exact[s] = u[s];
    exact[slot] += core::reduced_cost(component, u, arc);
  }
  log_->rest(parts);
  bound(component, exact);
  log_->leave();
}

void TreeLog::leave() {
  if (log_ != nullptr) log_->leave();
}

}  // namespace nda::bnb
