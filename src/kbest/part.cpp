#include "kbest/part.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "bnb/component_slack.hpp"
#include "relax/lagrangian.hpp"
#include "solve/component_solver.hpp"

namespace nda::kbest {

using core::ArcId;

namespace {

constexpr double kRounding = 0x1p-36;  // of a slack
constexpr int kEvaluations = 100;

}  // namespace

double beyond(double slack, double error) {
  return slack + kRounding * slack + 4 * error + std::numeric_limits<double>::min();
}

Part::Part(core::Component component, const SlackView& view)
    : component_(std::move(component)),
      price_(component_.num_slots(), 0.0),
      error_(pipeline::precision_of(component_, {}).error) {
  core::for_each_index(component_, [&](std::uint32_t s, std::size_t k, Index i) {
    price_[s] = view.price(view.slot(k, i));
  });
  const std::vector<ArcId>& best = view.best();
  for (ArcId a = 0; a < component_.num_arcs(); ++a) {
    const ArcId original = core::original_arc(component_, a);
    reduced_.push_back(view.reduced(original));
    if (std::binary_search(best.begin(), best.end(), original)) best_.push_back(a);
  }
  least_ = slack_of_best();
}

double Part::slack_of_best() const {
  std::vector<bool> covered(price_.size(), false);
  double slack = 0;
  for (const ArcId a : best_) {
    slack += reduced_[a];
    core::for_each_slot(component_, a, [&](std::uint32_t s) { covered[s] = true; });
  }
  for (std::size_t s = 0; s < price_.size(); ++s) {
    if (!covered[s]) slack += price_[s];
  }
  return slack;
}

void Part::tighten(const core::Deadline& deadline) {
  if (least_ <= beyond(0, error_)) return;
  relax::LagrangianOptions loop;
  loop.max_evaluations = kEvaluations;
  loop.deadline = deadline;
  loop.goal = core::make_packing(component_, best_).cost;
  const relax::LagrangianResult found = relax::maximize_dual(component_, {}, loop, {});
  if (!(loop.goal - found.lower < least_)) return;
  for (std::size_t s = 0; s < price_.size(); ++s) price_[s] = std::max(0.0, -found.u[s]);
  for (ArcId a = 0; a < reduced_.size(); ++a)
    reduced_[a] = std::max(0.0, core::reduced_cost(component_, found.u, a));
  least_ = slack_of_best();
}

double Part::all() const {
  double sum = 0;
  for (const double r : reduced_) sum += r;
  for (const double price : price_) sum += price < kInfinity ? price : 0;
  return sum;
}

SlackRanking Part::rank(double reach,
                        std::size_t k,
                        const bnb::SlackLimits& limits,
                        Combinations& combinations) const {
  const double budget = beyond(least_ + reach, error_);
  const bnb::ComponentSlack slack = bnb::slack_of(component_, price_, reduced_, budget);
  std::vector<std::uint32_t> names;
  for (const ArcId a : slack.arcs) names.push_back(core::original_arc(component_, a));
  return rank_slack(slack.problem, budget, k, limits, names, combinations);
}

}  // namespace nda::kbest
