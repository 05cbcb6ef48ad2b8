#include "kbest/slack_ranking.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "bnb/slack_moves.hpp"

// The search of bnb/slack_search for the k best instead of the best one.  The slack of any packing
// is a sum of terms >= 0, so whoever wants all packings within a budget may prune as one who wants
// the least: nothing in settle, ascend and force loses a packing within the budget.  Three things
// differ.
//
//   Rows of price 0 stay open: arcs that gain nothing make another packing all the same.
//   A node returns a list.  Where it divides, the k best sums of its parts' lists are found lazily
//   (Lawler 1972); where it branches, lists are merged.  Children exclude each other, so no packing
//   is found twice.
//   The budget of a node falls to the k-th best of its list: what one part contributes to the k
//   best of the whole is among the k best of the part.
//
// Whatever is left out for its slack exceeds the budget of its node by something; the least such
// excess says from where on there may be more.  For the first budget lacks of the node's what is
// spent elsewhere in any case; where it fell as a list was full, k others are no worse.
//
// That is ranking by AND/OR search; Marinescu & Dechter have it for graphical models.  Murty's
// partition (1968) instead solves a problem anew for every rank.

namespace nda::kbest {
namespace {

using bnb::OpenArc;
using bnb::OpenRow;
using bnb::SlackMoves;
using bnb::SlackNode;

constexpr std::size_t kMostDepth = 20000;
constexpr std::size_t kLongList = 1000;  // shorter ones are combined whatever the clock says

class Search {
 public:
  Search(const bnb::SlackProblem& problem,
         double budget,
         std::size_t k,
         const bnb::SlackLimits& limits,
         std::span<const std::uint32_t> names,
         Combinations& combinations,
         double margin)
      : problem_(problem),
        k_(k),
        margin_(margin),
        deadline_(limits.deadline),
        names_(names),
        combinations_(combinations),
        moves_(problem, budget, limits, bnb::FreeRows::kKeep) {}

  SlackRanking run(double budget) {
    moves_.open(nodes_[0]);
    SlackRanking result;
    result.packings = solve(0, budget);
    result.complete = !moves_.stopped();
    result.nodes = moves_.nodes();
    result.work = moves_.work();
    result.next = budget + moves_.excess();
    return result;
  }

 private:
  // What a list may still take.
  double limit(const RankedList& list, double budget) const {
    return list.size() < k_ ? budget : std::min(budget, list.back().slack - margin_);
  }

  // Whether anything is left of a budget; else what wanted it is left out.
  bool is_positive(double left) {
    if (left > 0) return true;
    moves_.leave_out(-left);
    return false;
  }

  // The k least below the budget.
  RankedList solve(std::size_t depth, double budget) {
    SlackNode& here = nodes_[depth];
    double spent = 0;
    if (!moves_.tighten(here, spent, budget, depth > kMostDepth)) return {};
    Combination forced = kNothing;
    for (const std::uint32_t arc : here.forced)
      forced = combinations_.join(forced, combinations_.single(names_[arc]));
    RankedList list = here.rows.empty() ? RankedList{{0, kNothing}} : divide(depth, budget - spent);
    return extend(std::move(list), spent, forced);
  }

  // Adds the same to all.
  RankedList extend(RankedList list, double slack, Combination arcs) {
    moves_.add_work(list.size());
    for (Ranked& ranked : list)
      ranked = {ranked.slack + slack, combinations_.join(arcs, ranked.arcs)};
    return list;
  }

  RankedList divide(std::size_t depth, double budget) {
    return moves_.falls_apart(nodes_[depth]) ? solve_parts(depth, budget) : branch(depth, budget);
  }

  RankedList solve_parts(std::size_t depth, double budget) {
    SlackNode& here = nodes_[depth];
    RankedList list = {{0, kNothing}};
    for (std::size_t p = 0; p < here.parts.size() && !list.empty(); ++p) {
      SlackNode& part = nodes_[depth + 1];
      here.parts.copy(p, here.arcs, here.rows, part.arcs, part.rows);
      part.may_split = false;
      const RankedList found = solve(depth + 1, budget - list.front().slack);
      double left_out = kInfinity;
      list = combine_ranked(list, found, k_, budget, combinations_, &left_out, deadline_);
      if (list.size() > kLongList) moves_.look_at_clock();  // or it may be cut short
      moves_.leave_out(left_out - budget);
      moves_.add_work(list.size());
    }
    return list;
  }

  RankedList branch(std::size_t depth, double budget) {
    SlackNode& here = nodes_[depth];
    const OpenRow row = moves_.narrowest(here, budget);
    moves_.list_choices(here, row.row);
    RankedList list;
    for (const OpenArc choice : here.choices) {
      const double left = limit(list, budget) - choice.reduced;
      if (moves_.stopped() || !is_positive(left)) break;
      moves_.occupy(choice.arc);
      moves_.take(here, std::span(&choice.arc, 1), left, nodes_[depth + 1]);
      merge(list, solve(depth + 1, left), choice.reduced, combinations_.single(names_[choice.arc]));
      // More arcs may fit into a cut: not in every order.
      if (row.row >= problem_.num_indices()) SlackMoves::drop(here, choice.arc);
    }
    const double price = row.left * row.price;
    const double left = limit(list, budget) - price;
    if (moves_.stopped() || !is_positive(left)) return list;
    moves_.leave(here, row.row, nodes_[depth + 1]);
    merge(list, solve(depth + 1, left), price, kNothing);
    return list;
  }

  void merge(RankedList& list, RankedList more, double slack, Combination arcs) {
    if (more.empty()) return;
    moves_.add_work(list.size() + more.size());
    merge_ranked(list, extend(std::move(more), slack, arcs), k_);
  }

  const bnb::SlackProblem& problem_;
  const std::size_t k_;
  const double margin_;
  const core::Deadline& deadline_;
  const std::span<const std::uint32_t> names_;
  Combinations& combinations_;
  SlackMoves moves_;
  bnb::NodesByDepth<SlackNode> nodes_;
};

}  // namespace

SlackRanking rank_slack(const bnb::SlackProblem& problem,
                        double budget,
                        std::size_t k,
                        const bnb::SlackLimits& limits,
                        std::span<const std::uint32_t> names,
                        Combinations& combinations,
                        double margin) {
  return Search(problem, budget, k, limits, names, combinations, margin).run(budget);
}

}  // namespace nda::kbest
