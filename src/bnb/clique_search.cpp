#include "bnb/clique_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bnb/arc_set.hpp"
#include "nda/proof.hpp"

// Packings of arcs are independent sets of the graph in which arcs that share an index are
// neighbours, and cliques of that graph bound them: at most one arc of a clique is used, so
// whatever share of the gains of its arcs is charged to a clique is paid once.  The search charges
// shares clique by clique until the budget is used up, that is, what a packing must gain more than.
// Arcs that are charged in full cannot beat the budget among themselves, so one of the others must
// be used: these are the branches, each with the arcs charged in full and the branches before it.
//
// Covers by weighted cliques go back to Babel (1994, "A fast algorithm for the maximum weight
// clique problem"); the branching is that of Carraghan & Pardalos as Held, Cook & Sewell (2012,
// "Maximum-weight stable sets and safe lower bounds for graph coloring") use it.  Indices are
// cliques, but there are more: any arcs that share an index pairwise, and the greedy covers find
// them.  That is why this search ends where linear programs see a wide gap: many indices an arc,
// few arcs, dense exclusions.  What differs from those papers, measured in docs/cuts.md: cliques
// start from the arcs with the fewest open neighbours, counted anew at every node, and grow by
// what gains much and leaves room to grow.
//
// For the k best it keeps a list, and once that is full the budget is what a packing must gain more
// than the last of it.  Every packing comes once: by the last of its arcs among the branches.  Arcs
// that gain nothing make another packing all the same.  They can be charged nothing; no set of them
// beats a budget >= 0, and below 0 each that does is a branch.
//
// Gains are whole numbers, so nothing is rounded on the way and the order of sums does not matter.

namespace nda::bnb {
namespace {

using Gain = std::int64_t;

constexpr int kGainExponent = 61;  // the gains add up to less than 2^61 units and one an arc
constexpr double kWorkBetweenLooks = 1 << 17;
// The root's later branches hold more and more arcs.  Searches that came to an end within their
// work had seen a third of the branches or more after an eighth of it, hopeless ones less than a
// tenth. Those that saw two thirds need several times their work, but come to an end.
constexpr double kTrialShare = 0.125;
constexpr double kLeastProgress = 0.2;
constexpr double kGoodProgress = 0.7;
constexpr double kMostExtension = 16;
constexpr double kWorkPerLook = 1;  // at an arc by its set, in units of SlackLimits::max_work
constexpr double kWorkPerWord = 0.06;

// The gains in units.
class Units {
 public:
  explicit Units(const CliqueProblem& problem) {
    double total = 0;
    for (std::uint32_t a = 0; a < problem.num_arcs(); ++a) total += std::abs(problem.gain(a));
    if (!(total > 0)) return;
    constexpr double kLeast = std::numeric_limits<double>::denorm_min();
    unit_ = std::max(kLeast, std::ldexp(1.0, std::ilogb(total) + 1 - kGainExponent));
  }
  // All gains are multiples of it, but for rounding.
  explicit Units(double unit) : unit_(unit), rounds_up_(false) {}

  Gain gain(double gain) const {
    return static_cast<Gain>(rounds_up_ ? std::ceil(gain / unit_) : std::round(gain / unit_));
  }
  // What a packing must gain more than; none does beyond 2^62.
  Gain target(double target) const {
    constexpr double kMost = 0x1p62;
    return static_cast<Gain>(std::clamp(std::floor(target / unit_), -kMost, kMost));
  }
  double value(Gain units) const { return static_cast<double>(units) * unit_; }

 private:
  double unit_ = 1;
  bool rounds_up_ = true;
};

template <std::size_t kWords>
class CliqueSearch {
 public:
  CliqueSearch(const CliqueProblem& problem,
               std::size_t k,
               double target,
               const Units& units,
               const CliqueLimits& limits)
      : limits_(limits),
        units_(units),
        k_(k),
        cutoff_(units_.target(target)),
        number_(problem.num_arcs()),
        neighbours_(problem.num_arcs()),
        rest_(problem.num_arcs(), 0) {
    link(problem);
  }

  CliqueRanking run() {
    Set open;
    for (std::uint32_t a = 0; a < number_.size(); ++a) open.insert(a);
    explore(open, 0);
    CliqueRanking result;
    std::sort_heap(found_.begin(), found_.end(), comes_before);
    for (const Found& found : found_) {
      CliquePacking& packing = result.packings.emplace_back();
      packing.gain = units_.value(found.gain);
      for (const std::uint32_t a : found.arcs) packing.arcs.push_back(number_[a]);
      std::sort(packing.arcs.begin(), packing.arcs.end());
    }
    result.complete = !stopped_;
    result.nodes = nodes_;
    result.work = work_;
    return result;
  }

 private:
  using Set = ArcSet<kWords>;
  struct Found {
    Gain gain;
    std::uint64_t number;  // in this order
    std::vector<std::uint32_t> arcs;
  };
  static bool comes_before(const Found& a, const Found& b) {
    return a.gain != b.gain ? a.gain > b.gain : a.number < b.number;
  }

  // Arcs with few neighbours get small numbers, which decide ties.
  void link(const CliqueProblem& problem) {
    const std::vector<Set> by_number = neighbours_of(problem);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_degree;
    for (std::uint32_t a = 0; a < by_number.size(); ++a)
      by_degree.emplace_back(by_number[a].count_common(by_number[a]), a);
    std::sort(by_degree.begin(), by_degree.end());
    std::vector<std::uint32_t> place(number_.size());
    for (std::uint32_t i = 0; i < number_.size(); ++i) {
      number_[i] = by_degree[i].second;
      place[number_[i]] = i;
    }
    for (std::uint32_t i = 0; i < number_.size(); ++i) {
      by_number[number_[i]].for_each([&](std::uint32_t b) { neighbours_[i].insert(place[b]); });
      gain_.push_back(units_.gain(problem.gain(number_[i])));
    }
  }

  static std::vector<Set> neighbours_of(const CliqueProblem& problem) {
    std::vector<Set> users(problem.num_rows());
    for (std::uint32_t a = 0; a < problem.num_arcs(); ++a) {
      for (const std::uint32_t row : problem.rows(a)) users[row].insert(a);
    }
    std::vector<Set> neighbours(problem.num_arcs());
    for (std::uint32_t a = 0; a < problem.num_arcs(); ++a) {
      for (const std::uint32_t row : problem.rows(a)) neighbours[a] |= users[row];
      neighbours[a].erase(a);
    }
    return neighbours;
  }

  bool is_too_long() {
    const double share = work_ / limits_.max_work;
    const bool hopeless = share > kTrialShare && progress_ < kLeastProgress;
    const bool late = share > 1 && progress_ < kGoodProgress;
    return stopped_ = stopped_ || hopeless || late || share > kMostExtension;
  }

  bool is_stopped() {
    if (nodes_ >= limits_.max_nodes || is_too_long()) return stopped_ = true;
    ++nodes_;
    if (work_ - work_at_look_ > kWorkBetweenLooks) {
      work_at_look_ = work_;
      stopped_ = stopped_ || limits_.deadline.reached();
    }
    return stopped_;
  }

  // All packings that add open arcs to the chosen ones, which gain `gain`.
  void explore(Set open, Gain gain) {
    if (is_stopped()) return;
    if (chosen_.size() > std::size_t{kMostProofSearchDepth}) {
      stopped_ = true;
      return;
    }
    if (gain > cutoff_) keep_chosen(gain);
    const std::size_t first = branches_.size();
    list_branches(open, cutoff_ - gain);
    for (std::size_t b = first; b < branches_.size(); ++b) open.erase(branches_[b]);
    const std::size_t end = branches_.size();
    for (std::size_t b = first; b < end && !stopped_; ++b) {
      if (chosen_.empty()) progress_ = static_cast<double>(b) / static_cast<double>(end);
      const std::uint32_t a = branches_[b];
      Set left = open;
      left -= neighbours_[a];
      chosen_.push_back(a);
      explore(left, gain + gain_[a]);
      chosen_.pop_back();
      open.insert(a);
    }
    branches_.resize(first);
  }

  // Among the k best found, behind those that gain as much.
  [[gnu::noinline]] void keep_chosen(Gain gain) {
    found_.push_back({gain, num_found_++, chosen_});
    std::push_heap(found_.begin(), found_.end(), comes_before);
    if (found_.size() > k_) {
      std::pop_heap(found_.begin(), found_.end(), comes_before);
      found_.pop_back();
    }
    if (found_.size() == k_) cutoff_ = found_.front().gain;
  }

  // Those open arcs that a cover of cliques worth `budget` leaves over, fewest neighbours first.
  [[gnu::noinline]] void list_branches(const Set& open, Gain budget) {
    sort_by_degree(open);
    Set left = open;
    bool paid = budget <= 0;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const std::uint32_t a = arc_at(i);
      if (gain_[a] <= std::min<Gain>(0, budget)) continue;
      while (!paid && left.contains(a)) paid = charge(a, left, budget) || is_too_long();
      if (left.contains(a)) branches_.push_back(a);
    }
  }

  void sort_by_degree(const Set& open) {
    order_.clear();
    open.for_each([&](std::uint32_t a) {
      order_.push_back(neighbours_[a].count_common(open) << 16 | a);
      rest_[a] = gain_[a];
    });
    std::sort(order_.begin(), order_.end());
    spend(order_.size());
  }
  std::uint32_t arc_at(std::size_t i) const { return order_[i] & 0xffff; }

  // Charges a clique around an arc for as much as the budget pays; takes arcs that are charged in
  // full out of `left`.  Returns whether the budget is used up.
  bool charge(std::uint32_t arc, Set& left, Gain& budget) {
    grow_clique(arc, left);
    Gain price = budget;
    for (const std::uint32_t a : clique_) price = std::min(price, rest_[a]);
    for (const std::uint32_t a : clique_) {
      rest_[a] -= price;
      if (rest_[a] == 0) left.erase(a);
    }
    budget -= price;
    return budget == 0;
  }

  void grow_clique(std::uint32_t arc, const Set& left) {
    clique_.assign(1, arc);
    Set fitting = left;
    fitting &= neighbours_[arc];
    for (;;) {
      double most = 0;
      std::uint32_t next = 0;
      std::size_t looks = 0;
      fitting.for_each([&](std::uint32_t a) {
        ++looks;
        const double room = 1 + neighbours_[a].count_common(fitting);
        const double worth = static_cast<double>(rest_[a]) * room;
        if (worth <= most) return;
        most = worth;
        next = a;
      });
      spend(looks);
      if (most == 0) return;
      clique_.push_back(next);
      fitting &= neighbours_[next];
    }
  }

  void spend(std::size_t looks) {
    work_ += static_cast<double>(looks) * (kWorkPerLook + kWorkPerWord * kWords);
  }

  const CliqueLimits& limits_;
  const Units units_;
  const std::size_t k_;
  Gain cutoff_;               // the target at first
  std::vector<Found> found_;  // a heap, the last on top
  std::uint64_t num_found_ = 0;
  std::vector<std::uint32_t> number_;  // of the problem's arcs, fewest neighbours first
  std::vector<Set> neighbours_;
  std::vector<Gain> gain_;
  std::vector<std::uint32_t> chosen_;
  std::vector<std::uint32_t> branches_;  // of all nodes from the root to here
  // Of the node at hand.
  std::vector<std::uint32_t> order_;  // 2^16 * degree + arc, ascending
  std::vector<Gain> rest_;            // [arc]: not yet charged
  std::vector<std::uint32_t> clique_;
  std::int64_t nodes_ = 0;
  double work_ = 0;
  double work_at_look_ = 0;
  double progress_ = 0;  // share of the root's branches that are done
  bool stopped_ = false;
};

CliqueRanking rank(const CliqueProblem& problem,
                   std::size_t k,
                   double target,
                   const Units& units,
                   const CliqueLimits& limits) {
  const std::uint32_t arcs = problem.num_arcs();
  if (arcs <= 64) return CliqueSearch<1>(problem, k, target, units, limits).run();
  if (arcs <= 128) return CliqueSearch<2>(problem, k, target, units, limits).run();
  if (arcs <= 256) return CliqueSearch<4>(problem, k, target, units, limits).run();
  if (arcs <= 512) return CliqueSearch<8>(problem, k, target, units, limits).run();
  if (arcs <= kMostCliqueArcs) return CliqueSearch<16>(problem, k, target, units, limits).run();
  return {};
}

}  // namespace

void CliqueProblem::add_arc(double gain, std::span<const std::uint32_t> rows) {
  gain_.push_back(gain);
  rows_.insert(rows_.end(), rows.begin(), rows.end());
  start_.push_back(rows_.size());
  for (const std::uint32_t row : rows) num_rows_ = std::max(num_rows_, row + 1);
}

CliqueResult search_cliques(const CliqueProblem& problem,
                            double target,
                            const CliqueLimits& limits) {
  const Units units(problem);
  CliqueRanking found = rank(problem, 1, std::max(target, -units.value(1)), units, limits);
  CliqueResult result;
  if (found.complete) result.most = found.packings.empty() ? target : found.packings.front().gain;
  if (!found.packings.empty()) result.arcs = std::move(found.packings.front().arcs);
  result.complete = found.complete;
  result.nodes = found.nodes;
  result.work = found.work;
  return result;
}

CliqueRanking rank_cliques(const CliqueProblem& problem,
                           std::size_t k,
                           double target,
                           double unit,
                           const CliqueLimits& limits) {
  return rank(problem, k, target, unit > 0 ? Units(unit) : Units(problem), limits);
}

}  // namespace nda::bnb
