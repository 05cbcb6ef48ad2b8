#include "kbest/part.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "kbest/slack_ranking.hpp"
#include "kbest/tighter_slack.hpp"
#include "solve/component_solver.hpp"

namespace nda::kbest {

using core::ArcId;

namespace {

constexpr double kRounding = 0x1p-36;  // of a slack
constexpr double kTightReach = 1.5;  // what is tightened serves so many times the reach
constexpr double kTrialWork = 4e6;  // before a tighter slack is looked for

}  // namespace

double beyond(double slack, double error) {
  return slack + kRounding * slack + 4 * error + std::numeric_limits<double>::min();
}

Part::Part(core::Component component, const SlackView& view) : component_(std::move(component)) {
  std::vector<double> price(component_.num_slots(), 0.0);
  core::for_each_index(component_, [&](std::uint32_t s, std::size_t k, Index i) {
    price[s] = view.price(view.slot(k, i));
    largest_ = std::max(largest_, std::abs(view.multipliers().base[k][i]));
  });
  std::vector<double> reduced;
  const std::vector<ArcId>& best = view.best();
  for (ArcId a = 0; a < component_.num_arcs(); ++a) {
    const ArcId original = core::original_arc(component_, a);
    largest_ = std::max(largest_, std::abs(view.problem().costs()[original]));
    reduced.push_back(view.reduced(original));
    if (std::binary_search(best.begin(), best.end(), original)) best_.push_back(a);
  }
  first_.slack = bnb::slack_of(component_, price, reduced, kInfinity);
  finish(first_);
}

// Fills in what follows from the slack.
void Part::finish(Form& form) const {
  const bnb::SlackProblem& slack = form.slack.problem;
  std::vector<std::uint32_t> used(slack.num_rows(), 0);
  for (const ArcId a : core::positions_in(form.slack.arcs, best_)) {
    form.least += slack.reduced(a);
    for (const bnb::RowUse use : slack.uses(a)) used[use.row] += use.coefficient;
  }
  double largest = largest_;
  for (std::uint32_t row = 0; row < slack.num_rows(); ++row) {
    if (slack.price(row) < kInfinity) largest = std::max(largest, slack.capacity(row) * slack.price(row));
    if (used[row] < slack.capacity(row)) form.least += (slack.capacity(row) - used[row]) * slack.price(row);
  }
  form.error = pipeline::precision_of(slack.num_rows(), largest, {}).error;
}

// For a reach somewhat larger.  Returns whether that leaves the best solution less slack.
bool Part::tighten(double reach, const core::Deadline& deadline) {
  Form tighter;
  tighter.reach = kTightReach * beyond(reach, first_.error);
  std::optional<bnb::ComponentSlack> slack =
      tighter_slack(component_, first_.slack.problem, best_, tighter.reach, deadline);
  if (!slack) return false;
  tighter.slack = std::move(*slack);
  finish(tighter);
  if (!(tighter.least < first_.least)) return false;
  tight_ = std::move(tighter);
  return true;
}

bool Part::rank(double reach,
                std::size_t k,
                const bnb::SlackLimits& limits,
                Combinations& combinations,
                std::int64_t& nodes) {
  if (listed_k_ > 0 && (k <= list_.size() || (list_.size() < listed_k_ && reach < reached_)))
    return true;
  const bool is_tight = tight_ && reach < tight_->reach;
  const bool may_tighten = !is_tight && first_.least > beyond(0, first_.error);
  bnb::SlackLimits trial = limits;
  if (may_tighten) trial.max_work = std::min(limits.max_work, kTrialWork);
  Found found = search(is_tight ? *tight_ : first_, reach, k, trial, combinations);
  nodes += found.nodes;
  trial.max_nodes = limits.max_nodes - found.nodes;
  trial.max_work = limits.max_work;
  if (!found.complete && may_tighten && trial.max_nodes > 0 && !limits.deadline.reached()) {
    const bool is_tighter = tighten(reach, limits.deadline);
    found = search(is_tighter ? *tight_ : first_, reach, k, trial, combinations);
    nodes += found.nodes;
  }
  if (!found.complete) return false;
  listed_k_ = k;
  reached_ = found.reached;
  list_ = std::move(found.list);
  return true;
}

// Over the arcs within the budget; the others are left out.
Part::Found Part::search(const Form& form,
                         double reach,
                         std::size_t k,
                         const bnb::SlackLimits& limits,
                         Combinations& combinations) const {
  const bnb::SlackProblem& slack = form.slack.problem;
  const double budget = beyond(form.least + reach, form.error);
  bnb::SlackProblem problem(slack.num_indices());
  for (std::uint32_t row = 0; row < slack.num_rows(); ++row)
    problem.add_row(slack.price(row), slack.capacity(row));
  std::vector<std::uint32_t> names;
  double next = form.least + form.reach;
  for (ArcId a = 0; a < slack.num_arcs(); ++a) {
    if (slack.reduced(a) < budget) {
      problem.add_arc(slack.reduced(a), slack.uses(a));
      names.push_back(core::original_arc(component_, form.slack.arcs[a]));
    } else {
      next = std::min(next, slack.reduced(a));
    }
  }
  SlackRanking ranking = rank_slack(problem, budget, k, limits, names, combinations);
  next = std::min(next, ranking.next);
  if (ranking.packings.size() == k) next = ranking.packings.back().slack;
  for (Ranked& ranked : ranking.packings) ranked.slack -= form.least;
  const double rounding = next < kInfinity ? kRounding * next + 4 * form.error : 0;
  return {std::move(ranking.packings), next - rounding - form.least, ranking.complete, ranking.nodes};
}

}  // namespace nda::kbest
