#include "reduce/reducer.hpp"

#include <algorithm>
#include <numeric>

#include "core/reduced_costs.hpp"
#include "reduce/cut_indices.hpp"
#include "reduce/dominated_arcs.hpp"
#include "reduce/outweighing_arcs.hpp"
#include "reduce/redundant_indices.hpp"
#include "reduce/single_choice_arcs.hpp"

// Every rule carries the multipliers along (each file says how), so what the rules settle is
// certified like everything else; settle() reckons the certificate anew from the multipliers and
// the arcs of the component, and needs to believe no rule.
//
// To settle a component all its arcs must go.  Hardly anything begins that but an arc that
// outweighs its rivals, and the cheapest arc is the one to ask, in one pass over the arcs as they
// stand; a pool is made only where the answer is yes, so that trying in vain costs next to nothing.

namespace nda::reduce {
namespace {

using core::ArcId;
using core::Component;

constexpr int kMostRounds = 30;
// A component is given up after a round that leaves more than so many arcs and removes less than
// this part of them.
constexpr std::size_t kFewArcs = 64;
constexpr double kGoodPart = 0.1;

double certificate_of(const Component& component, std::span<const double> u) {
  double certificate = std::accumulate(u.begin(), u.end(), 0.0);
  core::for_each_reduced_cost(
      component, u, {}, [&](ArcId, double r) { certificate += std::min(0.0, r); });
  return certificate;
}

// Whether the cheapest arc, if there is any, outweighs all it excludes (outweighing_arcs.hpp).
bool cheapest_outweighs(const Component& component) {
  if (component.num_arcs() == 0) return true;
  const auto cheapest = static_cast<ArcId>(
      std::min_element(component.costs.begin(), component.costs.end()) - component.costs.begin());
  std::vector<std::uint32_t> shared(component.num_arcs(), 0);
  for (std::size_t k = 0; k < component.sizes.size(); ++k) {
    const Index own = component.indices[k][cheapest];
    if (own == 0) continue;
    const Index* const column = component.indices[k].data();
    for (ArcId a = 0; a < shared.size(); ++a) shared[a] += column[a] == own;
  }
  shared[cheapest] = 0;
  double sum = 0;
  for (std::size_t k = 0; k < component.sizes.size(); ++k) {
    const Index own = component.indices[k][cheapest];
    if (own == 0) continue;
    const Index* const column = component.indices[k].data();
    double share = 0;
    for (ArcId a = 0; a < shared.size(); ++a) {
      if (column[a] == own && a != cheapest)
        share = std::min(share, component.costs[a] / shared[a]);
    }
    sum += share;
    if (sum < component.costs[cheapest]) return false;
  }
  return true;
}

}  // namespace

void Reducer::apply_quick_rules() {
  const Takings takings = take_outweighing_arcs(pool_);
  yield_.outweighing += takings.taken;
  yield_.excluded += takings.dropped;
  yield_.redundant += relieve_redundant_indices(pool_);
  const Transfers transfers = transfer_single_choices(pool_);
  yield_.single += transfers.chosen;
  yield_.unprofitable += transfers.dropped;
}

void Reducer::apply_thorough_rules() {
  yield_.dominated += drop_dominated_arcs(pool_);
  const Cuttings cuttings = cut_sides_off(pool_);
  yield_.sides += cuttings.sides;
  yield_.side_arcs += cuttings.dropped;
}

// The thorough rules where the quick ones did nothing.  Returns whether any rule did anything.
bool Reducer::round(Effort effort) {
  const std::size_t arcs = pool_.num_alive();
  const std::size_t redundant = yield_.redundant;
  const auto idle = [&] { return pool_.num_alive() == arcs && yield_.redundant == redundant; };
  apply_quick_rules();
  if (effort == Effort::kAll && idle()) apply_thorough_rules();
  return !idle();
}

void Reducer::run_rounds(const Component& component, Effort effort, bool patient) {
  pool_.reset(component);
  yield_.components = 1;
  yield_.arcs = component.num_arcs();
  for (int n = 0; n < kMostRounds && pool_.num_alive() > 0; ++n) {
    const std::size_t before = pool_.num_alive();
    if (!round(effort)) break;
    const auto removed = static_cast<double>(before - pool_.num_alive());
    const bool slow = removed < kGoodPart * static_cast<double>(before);
    if (!patient && pool_.num_alive() > kFewArcs && slow) break;
  }
  yield_.left = pool_.num_alive();
}

void Reducer::reduce(const Component& component, Effort effort) {
  yield_ = {};
  run_rounds(component, effort, true);
}

std::optional<Settled> Reducer::settle(const Component& component, Effort effort) {
  yield_ = {};
  if (effort == Effort::kQuick && !cheapest_outweighs(component)) return std::nullopt;
  run_rounds(component, effort, false);
  if (pool_.num_alive() > 0) return std::nullopt;
  Settled settled{pool_.restore(component, {}), {}, 0};
  settled.u.assign(pool_.charges().begin(), pool_.charges().end());
  settled.certificate = certificate_of(component, settled.u);
  return settled;
}

}  // namespace nda::reduce
