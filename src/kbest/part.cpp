#include "kbest/part.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bnb/component_slack.hpp"
#include "kbest/slack_ranking.hpp"
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
    : component_(std::move(component)), price_(component_.num_slots(), 0.0) {
  double largest = 0;
  core::for_each_index(component_, [&](std::uint32_t s, std::size_t k, Index i) {
    price_[s] = view.price(view.slot(k, i));
    largest = std::max(largest, std::abs(view.multipliers().base[k][i]));
  });
  const std::vector<ArcId>& best = view.best();
  for (ArcId a = 0; a < component_.num_arcs(); ++a) {
    const ArcId original = core::original_arc(component_, a);
    largest = std::max(largest, std::abs(view.problem().costs()[original]));
    reduced_.push_back(view.reduced(original));
    if (std::binary_search(best.begin(), best.end(), original)) best_.push_back(a);
  }
  error_ = pipeline::precision_of(component_.num_indices(), largest, {}).error;
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
}

bool Part::rank(double reach,
                std::size_t k,
                const bnb::SlackLimits& limits,
                Combinations& combinations,
                std::int64_t& nodes) {
  if (listed_k_ > 0 && (k <= list_.size() || (list_.size() < listed_k_ && reach < reached())))
    return true;
  const double budget = beyond(least_ + reach, error_);
  const bnb::ComponentSlack slack = bnb::slack_of(component_, price_, reduced_, budget);
  std::vector<std::uint32_t> names;
  for (const ArcId a : slack.arcs) names.push_back(core::original_arc(component_, a));
  SlackRanking found = rank_slack(slack.problem, budget, k, limits, names, combinations);
  nodes += found.nodes;
  if (!found.complete) return false;
  list_ = std::move(found.packings);
  listed_k_ = k;
  next_ = found.next;
  for (const double r : reduced_) next_ = r < budget ? next_ : std::min(next_, r);
  return true;
}

double Part::reached() const {
  if (listed_k_ == 0) return 0;
  const double next = list_.size() < listed_k_ ? next_ : list_.back().slack;
  if (next == kInfinity) return next;
  return next - (kRounding * next + 4 * error_) - least_;
}

}  // namespace nda::kbest
