#include "bounded/branch_and_bound.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <queue>
#include <tuple>

#include "bounded/bound.hpp"
#include "bounded/cut_pool.hpp"
#include "bounded/descent.hpp"
#include "bounded/relaxed_program.hpp"
#include "core/cheapest.hpp"

// A node is a list of arcs that are used or not, kept as a chain of decisions up to the root.  One
// linear program serves all nodes: going from one to another changes bounds of columns only, after
// which the dual simplex goes on from whatever basis there is.

namespace nda::bounded {
namespace {

using core::ArcId;

constexpr double kIntegral = 1e-6;
// Of column generation: columns to begin with and to add at once, per index.
constexpr std::size_t kFirstColumnsPerIndex = 6;
constexpr std::size_t kColumnsPerIndex = 2;
// A choice is rounded from the arcs of least reduced cost, so many per index.
constexpr std::size_t kRoundedArcsPerIndex = 6;
// Nodes between two roundings after the first dives.
constexpr std::int64_t kNodesPerRounding = 8;
constexpr std::int64_t kFirstRoundings = 64;
// Rounds of cuts at the root, and how many of them may fail to close a share of the gap.
constexpr int kMostCutRounds = 40;
constexpr int kMostFruitlessRounds = 3;
constexpr double kFruitfulShare = 0.02;

struct Decision {
  int parent;  // -1: the root
  ArcId arc;
  Use use;
};

struct Node {
  int decision;  // the last one; -1: the root
  double bound;

  bool operator<(const Node& other) const { return bound > other.bound; }  // the lowest on top
};

class Search {
 public:
  Search(const BoundedComponent& component,
         std::span<const Choice> starts,
         std::span<const double> u,
         const Wanted& wanted,
         const SearchLimits& limits,
         const SearchNews& news)
      : component_(component),
        wanted_(wanted),
        limits_(limits),
        news_(news),
        program_(component),
        uses_(component.num_arcs(), Use::kFree) {
    for (const Choice& start : starts) keep(start);
    result_.u.assign(u.begin(), u.end());
    clamp(component_, result_.u);
    result_.certificate = result_.lower = lagrangian_bound(component_, result_.u);
    result_.live_arcs = result_.left_arcs = component.num_arcs();
  }

  SearchResult run() {
    result_.end = search();
    if (!result_.choices.empty()) result_.best = result_.choices.front();
    return std::move(result_);
  }

 private:
  SearchEnd search();
  bool solve_root();
  bool price();
  bool cut();
  void fix_by_reduced_cost();
  void fix_by(std::span<const double> u, const CutPrices& prices, double bound);
  SearchEnd branch();
  SearchEnd dive(Node node);
  bool move_to(int decision);
  lp::Outcome solve_node();
  CutPrices prices(bool solved) const {
    return solved && pool_ ? pool_->prices(program_) : CutPrices{};
  }
  void round(std::span<const double> u);
  void offer_point();
  void offer_decided(std::span<const double> u, const CutPrices& charged);
  void offer_if_within(std::vector<ArcId> arcs);
  ArcId branching_arc(std::span<const double> u,
                      const CutPrices& charged,
                      double bound,
                      bool solved) const;
  bool keep(Choice choice);
  void offer(Choice choice);
  void raise(double lower);

  // Of the last that is wanted.
  double last_cost() const {
    const bool is_full = result_.choices.size() == wanted_.count;
    return is_full ? std::min(result_.choices.back().cost, wanted_.below) : wanted_.below;
  }
  double cutoff() const { return last_cost() - limits_.margin; }
  bool is_closed() const { return result_.lower >= cutoff(); }
  bool is_good_enough() const { return last_cost() - result_.lower <= limits_.allowed_gap; }

  static constexpr ArcId kNoArc = ~ArcId{0};

  const BoundedComponent& component_;
  const Wanted& wanted_;
  const SearchLimits& limits_;
  const SearchNews& news_;
  RelaxedProgram program_;
  std::vector<Use> uses_;    // [arc]: as the linear program has it
  std::vector<ArcId> live_;  // arcs that a better choice may use
  std::optional<CutPool> pool_;
  double fixed_at_ = kInfinity;
  std::vector<Decision> decisions_;
  std::vector<ArcId> decided_;  // on the way to where the linear program is
  std::priority_queue<Node> open_;
  SearchResult result_;
};

SearchEnd Search::search() {
  if (is_closed()) return SearchEnd::kComplete;
  if (!solve_root()) return SearchEnd::kDeadline;
  if (is_closed()) return SearchEnd::kComplete;
  if (is_good_enough()) return SearchEnd::kGap;
  if (limits_.max_nodes == 0) return SearchEnd::kNodes;
  fix_by_reduced_cost();
  result_.live_arcs = live_.size();
  if (!cut()) return SearchEnd::kDeadline;
  if (is_closed()) return SearchEnd::kComplete;
  open_.push({-1, result_.lower});
  const SearchEnd end = branch();
  if (end == SearchEnd::kComplete) raise(cutoff());
  return end;
}

// Column generation; false at the deadline.
bool Search::solve_root() {
  std::vector<ArcId> first = core::all_arcs(component_.graph);
  core::keep_cheapest(first, kFirstColumnsPerIndex * component_.rows.size() + 1, [&](ArcId a) {
    return core::reduced_cost(component_.graph, result_.u, a);
  });
  if (!result_.choices.empty()) {
    const std::vector<ArcId>& best = result_.choices.front().arcs;
    first.insert(first.end(), best.begin(), best.end());
  }
  std::sort(first.begin(), first.end());
  first.erase(std::unique(first.begin(), first.end()), first.end());
  program_.add_arcs(first);
  do {
    const lp::Outcome outcome = program_.solve_primal(limits_.deadline);
    if (outcome == lp::Outcome::kStopped) return false;
    if (outcome == lp::Outcome::kFailed) break;
  } while (price());
  round(program_.multipliers());
  return true;
}

// Takes the multipliers where they prove more, and adds arcs of negative reduced cost, the lowest
// first; false, and none added, when there are none or nothing better is left: round() reads the
// point of the linear program, which has to know all its arcs.
bool Search::price() {
  std::vector<double> u = program_.multipliers();
  const auto reduced = [&](ArcId a) { return core::reduced_cost(component_.graph, u, a); };
  std::vector<ArcId> added;
  for (ArcId a = 0; a < component_.num_arcs(); ++a) {
    if (!program_.has(a) && reduced(a) < 0) added.push_back(a);
  }
  core::keep_cheapest(added, kColumnsPerIndex * component_.rows.size() + 1, reduced);
  const double bound = lagrangian_bound(component_, u);
  if (bound > result_.certificate) {
    result_.certificate = bound;
    result_.u = std::move(u);
    raise(bound);
  }
  if (is_closed()) return false;
  program_.add_arcs(added);
  return !added.empty();
}

// Cuts at the root, as long as they raise the bound; false at the deadline.
bool Search::cut() {
  pool_.emplace(component_, live_);
  int fruitless = 0;
  for (int n = 0; n < kMostCutRounds && fruitless < kMostFruitlessRounds && !is_closed(); ++n) {
    const lp::Outcome outcome = program_.solve_dual(limits_.deadline, kInfinity);
    if (outcome == lp::Outcome::kStopped) return false;
    if (outcome != lp::Outcome::kOptimal) return true;
    const std::vector<double> u = program_.multipliers();
    const CutPrices prices = pool_->prices(program_);
    const double bound = lagrangian_bound(component_, u, uses_, prices);
    const bool fruitful = bound - result_.lower > kFruitfulShare * (cutoff() - result_.lower);
    fruitless = fruitful ? 0 : fruitless + 1;
    raise(std::min(bound, cutoff()));
    round(u);
    fix_by(u, prices, bound);
    if (pool_->separate(program_, limits_.deadline) == 0) return true;
  }
  return true;
}

// All arcs that a better choice may use, by the multipliers of the root.
void Search::fix_by_reduced_cost() {
  fixed_at_ = cutoff();
  fix_by(result_.u, {}, result_.certificate);
}

// The bound of all choices that use an arc of reduced cost r > 0 is higher by r.
void Search::fix_by(std::span<const double> u, const CutPrices& prices, double bound) {
  const double rounding = 0x1p-52 * (std::abs(cutoff()) + std::abs(bound));
  const double slack = cutoff() - bound + rounding;
  live_.clear();
  std::vector<ArcId> added;
  for (ArcId a = 0; a < component_.num_arcs(); ++a) {
    if (uses_[a] == Use::kNever) continue;
    const ReducedCost r = reduced_cost_and_error(component_.graph, u, prices, a);
    if (r.value - r.error >= slack) {
      uses_[a] = Use::kNever;
      if (program_.has(a)) program_.fix(a, Use::kNever);
      continue;
    }
    live_.push_back(a);
    if (!program_.has(a)) added.push_back(a);
  }
  program_.add_arcs(added);
  result_.left_arcs = live_.size();
}

SearchEnd Search::branch() {
  while (!open_.empty()) {
    const Node node = open_.top();
    raise(std::min(node.bound, cutoff()));
    if (node.bound >= cutoff()) return SearchEnd::kComplete;
    open_.pop();
    const SearchEnd end = dive(node);
    if (end != SearchEnd::kComplete) return end;
    if (cutoff() < fixed_at_ && move_to(-1)) fix_by_reduced_cost();
  }
  return SearchEnd::kComplete;
}

// Down from a node until its branch ends, which is kComplete; else it is open again.
SearchEnd Search::dive(Node node) {
  while (true) {
    const bool out_of_nodes = result_.nodes >= limits_.max_nodes;
    if (out_of_nodes || is_good_enough() || limits_.deadline.reached()) {
      open_.push(node);
      if (is_good_enough()) return SearchEnd::kGap;
      return out_of_nodes ? SearchEnd::kNodes : SearchEnd::kDeadline;
    }
    ++result_.nodes;
    if (!move_to(node.decision)) return SearchEnd::kComplete;
    const lp::Outcome outcome = solve_node();
    if (outcome == lp::Outcome::kStopped) {
      open_.push(node);
      return SearchEnd::kDeadline;
    }
    const bool solved = outcome == lp::Outcome::kOptimal;
    const std::vector<double> u = solved ? program_.multipliers() : result_.u;
    const CutPrices charged = prices(solved);
    const double bound = lagrangian_bound(component_, u, uses_, charged);
    node.bound = std::max(node.bound, bound);
    if (node.bound >= cutoff()) return SearchEnd::kComplete;
    if (solved) offer_point();
    if (result_.nodes <= kFirstRoundings || result_.nodes % kNodesPerRounding == 0) round(u);
    if (node.bound >= cutoff()) return SearchEnd::kComplete;
    const ArcId arc = branching_arc(u, charged, bound, solved);
    if (arc == kNoArc) {
      offer_decided(u, charged);
      return SearchEnd::kComplete;
    }
    const Use preferred = program_.use(arc) > 0.5 ? Use::kAlways : Use::kNever;
    const Use other = preferred == Use::kAlways ? Use::kNever : Use::kAlways;
    decisions_.push_back({node.decision, arc, other});
    open_.push({static_cast<int>(decisions_.size()) - 1, node.bound});
    decisions_.push_back({node.decision, arc, preferred});
    node.decision = static_cast<int>(decisions_.size()) - 1;
  }
}

// Puts the linear program where these decisions are; false where they exceed a bound or use what a
// better choice does not.
bool Search::move_to(int decision) {
  for (const ArcId a : decided_) {
    if (uses_[a] == Use::kFree) continue;
    uses_[a] = Use::kFree;
    program_.fix(a, Use::kFree);
  }
  decided_.clear();
  std::vector<Index> used(component_.rows.size(), 0);
  bool possible = true;
  for (int d = decision; d >= 0; d = decisions_[static_cast<std::size_t>(d)].parent) {
    const Decision& made = decisions_[static_cast<std::size_t>(d)];
    if (uses_[made.arc] == Use::kNever) {  // by its reduced cost
      if (made.use == Use::kAlways) return false;
      continue;
    }
    decided_.push_back(made.arc);
    uses_[made.arc] = made.use;
    program_.fix(made.arc, made.use);
    if (made.use == Use::kNever) continue;
    core::for_each_slot(component_.graph, made.arc, [&](std::uint32_t slot) {
      possible = possible && ++used[slot] <= component_.rows[slot].hi;
    });
  }
  return possible;
}

// What the linear program calls cut off is looked at again where its duals do not prove it.
lp::Outcome Search::solve_node() {
  lp::Outcome outcome = program_.solve_dual(limits_.deadline, cutoff());
  if (outcome != lp::Outcome::kCutoff) return outcome;
  if (lagrangian_bound(component_, program_.multipliers(), uses_, prices(true)) >= cutoff())
    return lp::Outcome::kOptimal;
  outcome = program_.solve_dual(limits_.deadline, kInfinity);
  return outcome == lp::Outcome::kCutoff ? lp::Outcome::kFailed : outcome;
}

// A choice near the point of the linear program: what it uses most comes first.
void Search::round(std::span<const double> u) {
  std::vector<std::pair<double, ArcId>> order;
  const auto note = [&](ArcId a) {
    order.emplace_back(core::reduced_cost(component_.graph, u, a), a);
  };
  if (live_.empty()) {
    for (ArcId a = 0; a < component_.num_arcs(); ++a) note(a);
  } else {
    std::for_each(live_.begin(), live_.end(), note);
  }
  // Arcs in use have reduced cost 0 or less.
  const std::size_t count = std::min(order.size(), kRoundedArcsPerIndex * component_.rows.size());
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(count);
  std::partial_sort(order.begin(), end, order.end());
  std::stable_sort(order.begin(), end, [&](const auto& one, const auto& other) {
    return program_.use(one.second) > program_.use(other.second);
  });
  std::vector<ArcId> arcs;
  std::for_each(order.begin(), end, [&](const auto& one) { arcs.push_back(one.second); });
  offer(greedy_descent(component_, arcs, limits_.deadline));
}

// What the point of the linear program uses for the greater part.
void Search::offer_point() {
  std::vector<ArcId> arcs;
  for (const ArcId a : live_) {
    if (program_.use(a) > 0.5) arcs.push_back(a);
  }
  offer_if_within(std::move(arcs));
}

void Search::offer_if_within(std::vector<ArcId> arcs) {
  const std::vector<Index> used = count_uses(component_.graph, arcs);
  for (std::size_t slot = 0; slot < used.size(); ++slot) {
    if (used[slot] > component_.rows[slot].hi) return;
  }
  offer(make_choice(component_, std::move(arcs)));
}

// Every arc is decided, or by its reduced cost: that is a choice.
void Search::offer_decided(std::span<const double> u, const CutPrices& charged) {
  std::vector<ArcId> arcs;
  for (const ArcId a : live_) {
    const bool is_free = uses_[a] == Use::kFree;
    const bool is_used = is_free ? reduced_cost_and_error(component_.graph, u, charged, a).value < 0
                                 : uses_[a] == Use::kAlways;
    if (is_used) arcs.push_back(a);
  }
  offer_if_within(std::move(arcs));
}

// The arc whose use is least decided; where all are, one that is still free, the least clear by its
// reduced cost.  None where no choice below the cutoff differs from what reduced costs say: the
// other use of an arc costs as much as that.
ArcId Search::branching_arc(std::span<const double> u,
                            const CutPrices& charged,
                            double bound,
                            bool solved) const {
  ArcId best = kNoArc;
  double best_score = kIntegral;
  for (const ArcId a : live_) {
    if (uses_[a] != Use::kFree || !solved) continue;
    const double use = program_.use(a);
    const double score = std::min(use, 1 - use);
    if (score <= best_score) continue;
    best_score = score;
    best = a;
  }
  if (best != kNoArc) return best;
  const double rounding = 0x1p-52 * (std::abs(cutoff()) + std::abs(bound));
  double least = cutoff() - bound + rounding;
  for (const ArcId a : live_) {
    if (uses_[a] != Use::kFree) continue;
    const ReducedCost r = reduced_cost_and_error(component_.graph, u, charged, a);
    if (std::abs(r.value) - r.error >= least) continue;
    least = std::abs(r.value) - r.error;
    best = a;
  }
  return best;
}

// Among the wanted; false where it is not, or known.
bool Search::keep(Choice choice) {
  std::vector<Choice>& known = result_.choices;
  if (choice.cost >= last_cost()) return false;
  if (wanted_.only_solutions && missing_uses(component_, choice.arcs) > 0) return false;
  const auto place = std::lower_bound(
      known.begin(), known.end(), choice, [](const Choice& one, const Choice& other) {
        return std::tie(one.cost, one.arcs) < std::tie(other.cost, other.arcs);
      });
  if (place != known.end() && place->arcs == choice.arcs) return false;
  known.insert(place, std::move(choice));
  if (known.size() > wanted_.count) known.pop_back();
  return true;
}

void Search::offer(Choice choice) {
  if (keep(std::move(choice)) && news_.found) news_.found(result_.choices.front());
}

void Search::raise(double lower) {
  if (lower <= result_.lower) return;
  result_.lower = lower;
  if (news_.bounded) news_.bounded(lower);
}

}  // namespace

SearchResult branch_and_bound(const BoundedComponent& component,
                              const Choice& start,
                              std::span<const double> u,
                              const SearchLimits& limits,
                              const SearchNews& news) {
  return Search(component, std::span(&start, 1), u, Wanted{}, limits, news).run();
}

SearchResult list_best(const BoundedComponent& component,
                       std::span<const Choice> starts,
                       std::span<const double> u,
                       const Wanted& wanted,
                       const SearchLimits& limits) {
  return Search(component, starts, u, wanted, limits, {}).run();
}

}  // namespace nda::bounded
