#include <algorithm>
#include <cmath>
#include <utility>

#include "core/random.hpp"
#include "cutting/dive.hpp"
#include "cutting/leaf_search.hpp"
#include "recovery/core_search.hpp"
#include "recovery/master_search.hpp"
#include "solve/component_solver.hpp"

// How a component gets better packings while linear programs and cuts raise its bound: local search
// first, then searches by the multipliers of the last linear program, cuts included.  Where the gap
// stays wide a proof is far away, and much more goes into packings, starting from dives.

namespace nda::pipeline {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;

// Work of neighbourhood search: at first, for every index, and where the gap is wide, for every
// pair of an index and an arc.
constexpr double kFirstWork = 1e6;
constexpr double kFirstWorkPerIndex = 5000;
constexpr double kMostFirstWork = 2.5e7;
constexpr double kWideWorkPerPair = 3000;
constexpr double kMostWideWork = 2e9;
constexpr double kWideGap = 0.01;
constexpr double kWideRounds = 16;
// For the bound: what took so much already may take long; if short searches find nothing any more,
// only what took much more.
constexpr double kHardWork = 1.5e8;
constexpr double kLongWork = 6e8;
constexpr double kDiveShare = 0.1;   // of that work
constexpr double kSwapsPerWork = 3;  // beside other work, where the gap is wide

}  // namespace

double ComponentSolver::first_work() const {
  const auto indices = static_cast<double>(component_.num_indices());
  return std::min(kMostFirstWork, kFirstWork + kFirstWorkPerIndex * indices);
}

double ComponentSolver::wide_work() const {
  const auto indices = static_cast<double>(component_.num_indices());
  const auto arcs = static_cast<double>(component_.num_arcs());
  return std::min(kMostWideWork, kWideWorkPerPair * indices * arcs);
}

bool ComponentSolver::may_search() const {
  return !state_.complete && options_.search.local_search && !deadline_.reached();
}

// What branch and cut leaves to the search for packings.
void ComponentSolver::improve(const Component& core,
                              std::span<const ArcId> live,
                              cutting::Master& point,
                              const cutting::PrimalBudget& budget) {
  double work = budget.work;
  std::vector<Packing> dives;
  if (++improvements_ == 1) {
    if (searched_) return;
    search(0);
    search_by_master(core, live, point, {}, first_work(), 0);
    work = 0;  // but for swaps, where that left the gap wide
  } else if (is_wide()) {
    const double first = budget.fruitful ? kHardWork : kLongWork;
    const bool is_due = budget.total >= (next_wide_search_ > 0 ? next_wide_search_ : first);
    if (is_due) {
      next_wide_search_ = 2 * budget.total;
      work = std::min(budget.total, wide_work());
    }
    work /= 1 + kSwapsPerWork;
    if (is_due) dives = dive(core, live, point, kDiveShare * work);
  }
  search_by_master(core, live, point, dives, work, swap_work(work));
}

// Packings of the core from dives that take as long as `work`.
std::vector<Packing> ComponentSolver::dive(const Component& core,
                                           std::span<const ArcId> live,
                                           cutting::Master& point,
                                           double work) {
  std::vector<Packing> found;
  core::Random random(seed_);
  const std::int64_t before = point.simplex_iterations();
  const auto done = [&] {
    return cutting::work_of_pivots(point.simplex_iterations() - before, core.num_slots());
  };
  while (done() < work && may_search()) {
    found.push_back(cutting::dive(core, point, random, deadline_));
    offer({core::at_positions(live, found.back().arcs), found.back().cost}, "dive");
  }
  std::stable_sort(found.begin(), found.end(), [](const Packing& a, const Packing& b) {
    return a.cost < b.cost;
  });
  return found;
}

// `live`: the arcs of the component that the core consists of.
void ComponentSolver::search_by_master(const Component& core,
                                       std::span<const ArcId> live,
                                       const cutting::Master& point,
                                       const std::vector<Packing>& others,
                                       double work,
                                       double swap_work) {
  if (!may_search() || work + swap_work <= 0) return;
  const Packing start{core::positions_in(live, state_.best.arcs), state_.best.cost};
  recovery::MasterSearchOptions search;
  search.least_round_work = others.empty() ? 0.0 : work / kWideRounds;
  search.swap_work = swap_work;
  search.max_work = work + search.swap_work;
  search.goal = search_goal();
  search.for_all = for_all_;
  core::Random random(seed_ + static_cast<std::uint64_t>(improvements_));
  const Packing found =
      recovery::search_by_master(core, point, start, others, search, random, deadline_);
  if (found.cost >= start.cost) return;
  offer({core::at_positions(live, found.arcs), found.cost}, "neighbourhoods");
}

// Work of swaps beside other work; what would be too little adds up.
double ComponentSolver::swap_work(double work) {
  if (!is_wide()) return 0;
  swap_credit_ += kSwapsPerWork * work;
  return swap_credit_ < least_swap_work_ ? 0 : std::exchange(swap_credit_, 0);
}

void ComponentSolver::search(double work) {
  if (!may_search()) return;
  recovery::CoreSearchOptions search;
  search.kicks_per_index = searched_ ? 0 : options_.search.kicks_per_index;
  search.neighbourhood_work = work;
  search.goal = search_goal();
  search.for_all = for_all_;
  core::Random random(seed_ + static_cast<std::uint64_t>(improvements_));
  searched_ = true;
  offer(recovery::search_core(component_,
                              state_.u,
                              state_.best.cost - state_.certificate,
                              state_.best,
                              search,
                              random,
                              deadline_),
        "neighbourhoods");
}

// Where most tuples are arcs a dimensionwise descent takes less time than whatever found the best
// packing, and improves most of them.
void ComponentSolver::reassign(double work) {
  if (!may_search() || !options_.search.dimensionwise) return;
  if (options_.method == Method::kRelaxation) return;
  if (component_.num_arcs() <= options_.branch.exact_arcs) return;
  if (!recovery::DimensionwiseSearch::suits(component_)) return;
  if (!dimensionwise_) dimensionwise_.emplace(component_, deadline_);
  core::Random random(seed_);
  Packing packing = state_.best;
  dimensionwise_->improve(packing, work, search_goal(), random);
  if (packing.cost < state_.best.cost) accept(packing, "dimensionwise");
}

// With a gap that wide a proof is far away; better solutions are not.
bool ComponentSolver::is_wide() const {
  return state_.best.cost - state_.lower > kWideGap * std::abs(state_.best.cost);
}

}  // namespace nda::pipeline
