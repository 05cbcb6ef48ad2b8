#include "reduce/reducer.hpp"

#include <algorithm>
#include <numeric>

#include "reduce/cut_indices.hpp"
#include "reduce/dominated_arcs.hpp"
#include "reduce/outweighing_arcs.hpp"
#include "reduce/redundant_indices.hpp"
#include "reduce/single_choice_arcs.hpp"

// The cheap rules come first, and dominance only where few arcs are left: its table costs more than
// all others together.  Every rule carries the multipliers along (each file says how), so what the
// rules settle is certified like everything else; settle() reckons the certificate anew from the
// multipliers and the arcs of the component, and needs to believe no rule.

namespace nda::reduce {
namespace {

using core::ArcId;
using core::Component;

constexpr int kMostRounds = 30;
constexpr std::size_t kSettleDominance = 256;
// A round that leaves more arcs than this must have removed a good part of them to go on.
constexpr std::size_t kFewArcs = 64;
constexpr double kGoodPart = 0.1;

double certificate_of(const Component& component, std::span<const double> u) {
  double certificate = std::accumulate(u.begin(), u.end(), 0.0);
  for (ArcId a = 0; a < component.num_arcs(); ++a)
    certificate += std::min(0.0, core::reduced_cost(component, u, a));
  return certificate;
}

}  // namespace

Yield& Yield::operator+=(const Yield& other) {
  dominated += other.dominated;
  redundant += other.redundant;
  outweighing += other.outweighing;
  excluded += other.excluded;
  single += other.single;
  unprofitable += other.unprofitable;
  sides += other.sides;
  side_arcs += other.side_arcs;
  left += other.left;
  return *this;
}

// Returns whether any rule did anything.
bool Reducer::round(std::size_t most_dominance) {
  const std::size_t before = pool_.num_alive();
  const Takings takings = take_outweighing_arcs(pool_);
  yield_.outweighing += takings.taken;
  yield_.excluded += takings.dropped;
  const std::size_t relieved = relieve_redundant_indices(pool_);
  yield_.redundant += relieved;
  const Transfers transfers = transfer_single_choices(pool_);
  yield_.single += transfers.chosen;
  yield_.unprofitable += transfers.dropped;
  if (pool_.num_alive() > 0 && pool_.num_alive() <= most_dominance)
    yield_.dominated += drop_dominated_arcs(pool_);
  if (pool_.num_alive() > 0 && pool_.num_alive() == before && relieved == 0) {
    const Cuttings cuttings = cut_sides_off(pool_);
    yield_.sides += cuttings.sides;
    yield_.side_arcs += cuttings.dropped;
  }
  return pool_.num_alive() < before || relieved > 0;
}

void Reducer::reduce(const Component& component, std::size_t most_dominance) {
  yield_ = {};
  pool_.reset(component);
  for (int n = 0; n < kMostRounds && pool_.num_alive() > 0; ++n) {
    if (!round(most_dominance)) break;
  }
  yield_.left = pool_.num_alive();
}

std::optional<Settled> Reducer::settle(const Component& component) {
  yield_ = {};
  pool_.reset(component);
  for (int n = 0; n < kMostRounds && pool_.num_alive() > 0; ++n) {
    const std::size_t before = pool_.num_alive();
    if (!round(kSettleDominance)) break;
    const auto removed = static_cast<double>(before - pool_.num_alive());
    if (pool_.num_alive() > kFewArcs && removed < kGoodPart * static_cast<double>(before)) break;
  }
  yield_.left = pool_.num_alive();
  if (pool_.num_alive() > 0) return std::nullopt;
  Settled settled{pool_.restore(component, {}), {}, 0};
  settled.u.assign(pool_.charges().begin(), pool_.charges().end());
  settled.certificate = certificate_of(component, settled.u);
  return settled;
}

}  // namespace nda::reduce
