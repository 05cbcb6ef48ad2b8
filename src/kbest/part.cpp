#include "kbest/part.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "kbest/arc_sets.hpp"
#include "kbest/clique_ranking.hpp"
#include "kbest/nearby_packings.hpp"
#include "kbest/refunds.hpp"
#include "kbest/slack_ranking.hpp"
#include "kbest/tighter_slack.hpp"
#include "kbest/tree_ranking.hpp"
#include "solve/component_solver.hpp"

// One search within the slack ends most parts.  Where it does not, four ways have their turn with
// patience that grows, since nobody can tell beforehand which is short: covers by cliques, which do
// not mind a wide gap; a tighter slack, in steps of the reach; branch and cut, where cuts pay; and,
// once that took long, a look at neighbourhoods of the packings known, since less reach means much
// less to look for.
//
// Whatever is known and costs no more than anything that is not listed is among the best.  On a
// grid of costs that saves whole searches: within the step below, all are listed; of those at the
// next point it takes only as many as are missing, whoever found them.

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
constexpr double kTrialWorkPerArc = 200;    // tightening takes as long
constexpr double kMorePatience = 16;        // from one search that was stopped to the next
constexpr int kMostRounds = 60;             // of cuts
constexpr int kFirstRounds = 8;             // where covers by cliques may do without
constexpr std::size_t kKnownAtOnce = 1000;  // whatever the clock says
constexpr double kLooseReach = 1.25;        // times what is wanted: worth tightening anew

}  // namespace

double beyond(double slack, double error) {
  return slack + kRounding * slack + 4 * error + std::numeric_limits<double>::min();
}

Part::Part(core::Component component,
           const SlackView& view,
           double grid,
           const PartPatience& patience)
    : component_(std::move(component)), grid_(grid), patience_(patience) {
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

const Part::Form& Part::form(double reach) const {
  return tight_ && reach < tight_->reach ? *tight_ : first_;
}

// For a reach somewhat larger, unless that is done or there is nothing to gain.  More cuts than
// before only where more rounds are allowed.
void Part::tighten(double reach, int max_rounds, const core::Deadline& deadline) {
  const double wanted = kTightReach * beyond(reach, first_.error);
  if (first_.least <= beyond(0, first_.error)) return;
  const bool is_close = tight_ && reach < tight_->reach && tight_->reach < kLooseReach * wanted;
  if (is_close && max_rounds <= tight_rounds_) return;
  std::optional<bnb::ComponentSlack> slack =
      tighter_slack(component_, first_.slack.problem, best_, wanted, max_rounds, deadline);
  if (!slack) return;
  Form tighter;
  tighter.reach = wanted;
  tighter.slack = std::move(*slack);
  finish(tighter);
  tight_rounds_ = max_rounds;
  if (tighter.least < first_.least) tight_ = std::move(tighter);
}

// What it is about, and what it did so far.
struct Part::Run {
  double reach;
  std::size_t k;
  const bnb::SlackLimits& limits;
  Combinations& combinations;
  std::int64_t& nodes;
  std::int64_t nodes_before;     // its limit counts from here
  std::size_t num_combinations;  // of which lists are made; what a search adds in vain goes again
  double work = 0;               // of all searches
  double work_at_nearby = 0;     // when it looked nearby last
  double within = -1;            // of the last search that was complete
  bool has_begun = false;        // with what is known

  bool is_done() const { return within >= reach; }
  std::int64_t nodes_left() const { return limits.max_nodes - (nodes - nodes_before); }
  bool is_stopped() const { return nodes_left() <= 0 || limits.deadline.reached(); }
  bnb::SlackLimits limits_of(double max_work) const {
    bnb::SlackLimits left = limits;
    left.max_nodes = nodes_left();
    left.max_work = std::min(limits.max_work, max_work);
    return left;
  }
};

bool Part::rank(double reach,
                std::size_t k,
                const bnb::SlackLimits& limits,
                Combinations& combinations,
                std::int64_t& nodes) {
  if (is_ranked(reach, k)) return true;
  Run run{reach, k, limits, combinations, nodes, nodes, combinations.size()};
  // Where the best solution has more slack than there is reach, a tighter one pays soon.
  const auto num_arcs = static_cast<double>(component_.num_arcs());
  const double trial =
      kTrialWorkPerArc * num_arcs + (first_.least < reach
                                         ? kTrialWork + kTrialWorkPerRank * static_cast<double>(k)
                                         : kShortTrialWork);
  if (take(run, rank_slacks(run, first_, reach, patience_.trial * trial), reach)) return true;
  const bool may_cover = patience_.cliques > 0 && may_rank_cliques(first_.slack.problem);
  NearbyPackings nearby(first_.slack.problem);
  int rounds = may_cover ? kFirstRounds : kMostRounds;
  int turn = 0;
  double work = patience_.search + patience_.search_per_arc * num_arcs;
  while (!run.is_done() && !is_ranked(reach, k)) {
    if (run.is_stopped()) return false;
    look_nearby(run, nearby);
    settle(run);
    if (is_ranked(reach, k)) break;
    const double most = most_within(run);
    if (may_cover && take(run, rank_by_cliques(run, most, patience_.cliques * work), most))
      continue;
    const double within = next_within(run);
    const bool may_branch = turn >= patience_.turns;
    if (may_branch && take(run, rank_by_branching(run, within, work), within)) continue;
    tighten(within, rounds, limits.deadline);
    if (take(run, rank_slacks(run, form(within), within, work), within)) continue;
    if (work > limits.max_work) return false;
    work *= kMorePatience;
    ++turn;
    rounds = kMostRounds;
  }
  return true;
}

// Returns whether the search came to an end; keeps what it found.
bool Part::take(Run& run, Found found, double within) {
  run.nodes += found.nodes;
  run.work += found.work;
  if (!found.complete) {
    if (!std::exchange(run.has_begun, true)) begin(run);
    know_all(found.list, run);
    run.combinations.keep_first(run.num_combinations);
    return false;
  }
  run.within = within;
  listed_k_ = run.k;
  reached_ = found.reached;
  list_ = std::move(found.list);
  run.num_combinations = run.combinations.size();
  return true;
}

// For what would make the next search shorter, or needless, after searches that took long.
void Part::look_nearby(Run& run, NearbyPackings& nearby) {
  const double work = run.work - run.work_at_nearby;
  if (work < patience_.nearby) return;
  run.work_at_nearby = run.work;
  know_all(list_, run);
  const double budget = beyond(first_.least + next_within(run), first_.error);
  run.nodes += nearby.search(*known_, budget, first_.least + settled(), run.limits_of(work));
}

// With what was known before, as many as are wanted now.
void Part::begin(const Run& run) {
  if (known_) {
    known_->resize(run.k);
  } else {
    known_.emplace(run.k);
    know(core::positions_in(first_.slack.arcs, best_));
  }
  know_all(list_, run);
}

void Part::know(std::vector<ArcId> arcs) {
  const double slack = slack_of_packing(first_.slack.problem, arcs);
  known_->add({std::move(arcs), slack});
}

// The first ones, and the others as long as there is time.
void Part::know_all(const RankedList& list, const Run& run) {
  for (std::size_t n = 0; n < list.size(); ++n) {
    if (n >= kKnownAtOnce && run.limits.deadline.reached()) return;
    const std::vector<ArcId> arcs =
        core::arcs_from_original(component_, run.combinations.arcs(list[n].arcs));
    know(core::positions_in(first_.slack.arcs, arcs));
  }
}

// What costs so much more than the best solution is no better than anything that is not listed.
double Part::settled() const {
  return reached_ + 2 * kGridErrors * first_.error;
}

// Lists what is known and settled.
void Part::settle(Run& run) {
  ArcSets is_listed;
  const auto ascending = [](std::vector<ArcId> arcs) {
    std::sort(arcs.begin(), arcs.end());
    return arcs;
  };
  for (const Ranked& ranked : list_) {
    if (is_listed.size() >= kKnownAtOnce && run.limits.deadline.reached()) return;
    is_listed.insert(ascending(run.combinations.arcs(ranked.arcs)));
  }
  for (const PackingBuffer::Kept& packing : known_->packings()) {
    if (list_.size() >= run.k || packing.cost - first_.least > settled()) break;
    if (list_.size() >= kKnownAtOnce && run.limits.deadline.reached()) break;
    const std::size_t before = run.combinations.size();
    const Ranked next = listed(packing, run.combinations);
    if (is_listed.insert(ascending(run.combinations.arcs(next.arcs))).second) {
      list_.push_back(next);
    } else {
      run.combinations.keep_first(before);
    }
  }
  std::ranges::stable_sort(list_, {}, &Ranked::slack);
  listed_k_ = std::max(listed_k_, run.k);
  run.num_combinations = run.combinations.size();
}

// What is known, as lists have it.
Ranked Part::listed(const PackingBuffer::Kept& packing, Combinations& combinations) const {
  Ranked ranked{packing.cost - first_.least, kNothing};
  for (const ArcId a : *packing.arcs) {
    const ArcId name = core::original_arc(component_, first_.slack.arcs[a]);
    ranked.arcs = combinations.join(ranked.arcs, combinations.single(name));
  }
  return ranked;
}

// As many as are known bound the last of the best, whatever else there is.  Beyond that lies
// nothing but what rounding put there.
double Part::most_within(const Run& run) const {
  const double most = std::min(run.reach, known_->cutoff() - first_.least);
  return run.within < most ? most : run.reach;
}

double Part::next_within(const Run& run) const {
  double most = most_within(run);
  if (most < run.reach) most = std::max(most - margin(first_.error), reached_);
  const double first = std::max(kFirstShare * most, kShareOfLeast * first_.least);
  return useful(std::max({first, kStep * std::max(0.0, run.within), reached_}), most);
}

// What a packing that is better at all is better by: nearly a step of the grid.
double Part::margin(double error) const {
  const double tolerance = kGridErrors * std::max(error, first_.error);
  return tolerance < kGridTolerance * grid_ ? grid_ - 4 * tolerance : 0;
}

// What packings that cost so much more than the best cost more at least: costs lie on a grid.
double Part::on_grid(double rise) const {
  const double tolerance = kGridErrors * first_.error;
  if (!(tolerance < kGridTolerance * grid_) || !(rise < kInfinity)) return rise;
  return std::max(rise, grid_ * std::ceil((rise - tolerance) / grid_) - tolerance);
}

// What packings cost more than the best that have so much slack or more.
double Part::reached_within(const Form& form, double budget) const {
  const double rounding = budget < kInfinity ? kRounding * budget + 4 * form.error : 0;
  return on_grid(budget - rounding - form.least);
}

// The largest reach up to `within` that takes in a point of the grid, or the next one; `most` if
// that is less.
double Part::useful(double within, double most) const {
  const double tolerance = kGridErrors * first_.error;
  if (tolerance < kGridTolerance * grid_)
    within = grid_ * std::floor((within + 2 * tolerance) / grid_) + 2 * tolerance;
  return std::min(within, most);
}

Part::Found Part::rank_slacks(const Run& run,
                              const Form& form,
                              double reach,
                              double max_work) const {
  const auto rank = [&](const bnb::SlackProblem& problem, double budget, const auto& names) {
    return rank_slack(problem,
                      budget,
                      run.k,
                      run.limits_of(max_work),
                      names,
                      run.combinations,
                      margin(form.error));
  };
  return search(form, reach, run.k, rank);
}

// All that it finds is known from then on; the list is what is within reach.
Part::Found Part::rank_by_branching(const Run& run, double reach, double max_work) {
  const bnb::SlackProblem& slack = first_.slack.problem;
  const double budget = beyond(first_.least + reach, first_.error);
  const TreeRanking tree = rank_by_tree(component_,
                                        slack,
                                        budget,
                                        margin(first_.error),
                                        run.limits_of(max_work),
                                        *known_,
                                        patience_.leaf_work);
  Found found{{}, 0, tree.complete, tree.nodes, tree.work};
  if (!tree.complete) return found;
  for (const PackingBuffer::Kept& packing : known_->packings()) {
    if (packing.cost < budget) found.list.push_back(listed(packing, run.combinations));
  }
  double next = budget > greatest_slack(slack) ? kInfinity : budget;
  if (found.list.size() == run.k) next = known_->packings().back().cost;
  found.reached = reached_within(first_, next);
  return found;
}

Part::Found Part::rank_by_cliques(const Run& run, double reach, double max_work) const {
  const double step = margin(first_.error) > 0 ? grid_ : 0;
  const auto rank = [&](const bnb::SlackProblem& problem, double budget, const auto& names) {
    return rank_cliques(
        problem, budget, run.k, step, run.limits_of(max_work), names, run.combinations);
  };
  return search(first_, reach, run.k, rank);
}

// Over the arcs within the budget; the others are left out.
template <typename Rank>
Part::Found Part::search(const Form& form, double reach, std::size_t k, Rank&& rank) const {
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
  SlackRanking ranking = rank(problem, budget, names);
  next = std::min(next, ranking.next);
  if (ranking.packings.size() == k) next = ranking.packings.back().slack;
  for (Ranked& ranked : ranking.packings) ranked.slack -= form.least;
  return {std::move(ranking.packings),
          reached_within(form, next),
          ranking.complete,
          ranking.nodes,
          ranking.work};
}

}  // namespace nda::kbest
