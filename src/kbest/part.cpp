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

constexpr double kRounding = 0x1p-36;      // of a slack
constexpr double kFirstShare = 1.0 / 64;   // of the reach, where it is beyond what a trial manages
constexpr double kShareOfLeast = 1.0 / 8;  // of the slack of the best solution, at least
constexpr double kStep = 1.6;              // from one reach to the next
constexpr double kTightReach = 2.5;        // what is tightened serves so many times the reach
constexpr double kGridErrors = 8;          // that rounding may be from a point of the grid
constexpr double kGridTolerance = 0x1p-6;  // of its step, at most
constexpr double kTrialWork = 3e5;         // before a tighter slack is looked for
constexpr double kTrialWorkPerRank = 1e5;
constexpr double kShortTrialWork = 5e4;
constexpr double kTrialWorkPerArc = 200;  // tightening takes as long

}  // namespace

double beyond(double slack, double error) {
  return slack + kRounding * slack + 4 * error + std::numeric_limits<double>::min();
}

Part::Part(core::Component component, const SlackView& view, double grid)
    : component_(std::move(component)), grid_(grid) {
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
    if (slack.price(row) < kInfinity)
      largest = std::max(largest, slack.capacity(row) * slack.price(row));
    if (used[row] < slack.capacity(row))
      form.least += (slack.capacity(row) - used[row]) * slack.price(row);
  }
  form.error = pipeline::precision_of(slack.num_rows(), largest, {}).error;
}

bool Part::is_ranked(double reach, std::size_t k) const {
  return listed_k_ > 0 && (k <= list_.size() || (list_.size() < listed_k_ && reach < reached_));
}

void Part::keep(Found found, std::size_t k) {
  listed_k_ = k;
  reached_ = found.reached;
  list_ = std::move(found.list);
}

const Part::Form& Part::form(double reach) const {
  return tight_ && reach < tight_->reach ? *tight_ : first_;
}

// For a reach somewhat larger, unless that is done or there is nothing to gain.
void Part::tighten(double reach, const core::Deadline& deadline) {
  if (first_.least <= beyond(0, first_.error) || (tight_ && reach < tight_->reach)) return;
  Form tighter;
  tighter.reach = kTightReach * beyond(reach, first_.error);
  std::optional<bnb::ComponentSlack> slack =
      tighter_slack(component_, first_.slack.problem, best_, tighter.reach, deadline);
  if (!slack) return;
  tighter.slack = std::move(*slack);
  finish(tighter);
  if (tighter.least < first_.least) tight_ = std::move(tighter);
}

bool Part::rank(double reach,
                std::size_t k,
                const bnb::SlackLimits& limits,
                Combinations& combinations,
                std::int64_t& nodes) {
  if (is_ranked(reach, k)) return true;
  const std::int64_t before = nodes;
  bnb::SlackLimits search = limits;
  double most = reach;
  const auto rank_within = [&](double within) {
    Found found = this->search(form(within), within, k, search, combinations);
    nodes += found.nodes;
    search.max_nodes = limits.max_nodes - (nodes - before);
    if (found.list.size() == k) most = std::min(most, found.list.back().slack);
    if (found.complete) keep(std::move(found), k);
    return found.complete;
  };
  // Where the best solution has more slack than there is reach, a tighter one pays soon.
  const double trial = first_.least < reach
                           ? kTrialWork + kTrialWorkPerRank * static_cast<double>(k)
                           : kShortTrialWork;
  const double per_arc = kTrialWorkPerArc * static_cast<double>(component_.num_arcs());
  search.max_work = std::min(limits.max_work, trial + per_arc);
  if (rank_within(reach)) return true;
  search.max_work = limits.max_work;
  // As many as are found bound the last of the best, whatever else there is.
  double within = useful(std::max(kFirstShare * most, kShareOfLeast * first_.least), most);
  while (!is_ranked(reach, k)) {
    if (search.max_nodes <= 0 || limits.deadline.reached()) return false;
    tighten(within, limits.deadline);
    if (!is_ranked(within, k) && !rank_within(within)) return false;
    if (!(within < reach)) return true;
    // Beyond what bounds the last of them lies nothing but what rounding put there.
    within = useful(std::max(kStep * within, reached_), within < most ? most : reach);
  }
  return true;
}

// What packings that cost so much more than the best cost more at least: costs lie on a grid.
double Part::on_grid(double rise) const {
  const double tolerance = kGridErrors * first_.error;
  if (!(tolerance < kGridTolerance * grid_) || !(rise < kInfinity)) return rise;
  return std::max(rise, grid_ * std::ceil((rise - tolerance) / grid_) - tolerance);
}

// The largest reach up to `within` that takes in a point of the grid, or the next one; `most` if
// that is less.
double Part::useful(double within, double most) const {
  const double tolerance = kGridErrors * first_.error;
  if (tolerance < kGridTolerance * grid_)
    within = grid_ * std::floor((within + 2 * tolerance) / grid_) + 2 * tolerance;
  return std::min(within, most);
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
  return {std::move(ranking.packings),
          on_grid(next - rounding - form.least),
          ranking.complete,
          ranking.nodes};
}

}  // namespace nda::kbest
