#include "bnb/slack_search.hpp"

#include <algorithm>

#include "bnb/slack_moves.hpp"

// Good multipliers leave a budget that pays for few deviations from zero slack, so what decides is
// how cheaply a node is seen through.  Five things are done at a node, all in one pass over the
// arcs that still fit and are affordable: settle, ascend and force (bnb/slack_moves), then
//
//   split    what falls apart is solved part by part, each within what the others left of the
//            budget: a sum of searches where there was a product (Marinescu & Dechter 2009 call
//            it AND/OR search).  Tracking problems fall apart after a few decisions;
//   branch   on the row with the fewest uses, dear ones counting less: one of its arcs is used, or
//            none.
//
// Rounding: sums of terms below the budget err by far less than kTolerance of it, so a budget that
// much larger loses nothing.

namespace nda::bnb {
namespace {

constexpr double kTolerance = 0x1p-36;

class SlackSearch {
 public:
  SlackSearch(const SlackProblem& problem, double budget, const SlackLimits& limits)
      : problem_(problem), moves_(problem, budget, limits, FreeRows::kDrop) {}

  SlackResult run(double budget) {
    Node& root = nodes_[0];
    moves_.open(root);
    SlackResult result;
    result.slack = solve(0, budget < kInfinity ? budget + kTolerance * budget : budget);
    if (result.slack < kInfinity) result.arcs = root.best;
    result.complete = !moves_.stopped();
    result.nodes = moves_.nodes();
    result.work = moves_.work();
    return result;
  }

 private:
  struct Node : SlackNode {
    std::vector<std::uint32_t> best;  // arcs of the best packing found
  };

  // Least slack below the budget, or +inf; its arcs are then the node's best.
  double solve(std::size_t depth, double budget) {
    Node& here = nodes_[depth];
    here.best.clear();
    double spent = 0;
    if (!moves_.tighten(here, spent, budget, depth > std::size_t{kMostProofSearchDepth}))
      return kInfinity;
    if (!here.rows.empty()) spent += divide(depth, budget - spent);
    if (!(spent < budget)) return kInfinity;
    here.best.insert(here.best.end(), here.forced.begin(), here.forced.end());
    return spent;
  }

  double divide(std::size_t depth, double budget) {
    return moves_.falls_apart(nodes_[depth]) ? solve_parts(depth, budget) : branch(depth, budget);
  }

  double solve_parts(std::size_t depth, double budget) {
    Node& here = nodes_[depth];
    double spent = 0;
    for (std::size_t p = 0; p < here.parts.size(); ++p) {
      Node& part = nodes_[depth + 1];
      here.parts.copy(p, here.arcs, here.rows, part.arcs, part.rows);
      part.may_split = false;
      const double slack = solve(depth + 1, budget - spent);
      if (!(slack < budget - spent)) return kInfinity;
      spent += slack;
      here.best.insert(here.best.end(), part.best.begin(), part.best.end());
    }
    return spent;
  }

  double branch(std::size_t depth, double budget) {
    Node& here = nodes_[depth];
    const OpenRow row = moves_.narrowest(here, budget);
    moves_.list_choices(here, row.row);
    double least = kInfinity;
    for (const OpenArc choice : here.choices) {
      const double limit = std::min(budget, least) - choice.reduced;
      if (moves_.stopped() || !(limit > 0)) break;
      moves_.occupy(choice.arc);
      moves_.take(here, std::span(&choice.arc, 1), limit, nodes_[depth + 1]);
      const double slack = solve(depth + 1, limit);
      if (slack < limit) {
        least = choice.reduced + slack;
        here.best = nodes_[depth + 1].best;
        here.best.push_back(choice.arc);
      }
      // More arcs may fit into a cut: not in every order.
      if (row.row >= problem_.num_indices()) SlackMoves::drop(here, choice.arc);
    }
    const double price = row.left * row.price;
    const double limit = std::min(budget, least) - price;
    if (moves_.stopped() || !(limit > 0)) return least;
    moves_.leave(here, row.row, nodes_[depth + 1]);
    const double slack = solve(depth + 1, limit);
    if (!(slack < limit)) return least;
    here.best = nodes_[depth + 1].best;
    return price + slack;
  }

  const SlackProblem& problem_;
  SlackMoves moves_;
  NodesByDepth<Node> nodes_;
};

}  // namespace

void SlackProblem::reserve(std::size_t rows, std::size_t arcs, std::size_t uses) {
  price_.reserve(rows);
  capacity_.reserve(rows);
  reduced_.reserve(arcs);
  start_.reserve(arcs + 1);
  num_index_uses_.reserve(arcs);
  uses_.reserve(uses);
}

std::uint32_t SlackProblem::add_row(double price, std::uint32_t capacity) {
  price_.push_back(price);
  capacity_.push_back(capacity);
  return num_rows() - 1;
}

std::uint32_t SlackProblem::add_arc(double reduced, std::span<const RowUse> uses) {
  reduced_.push_back(reduced);
  uses_.insert(uses_.end(), uses.begin(), uses.end());
  start_.push_back(uses_.size());
  const auto is_cut = [&](const RowUse& use) { return use.row >= num_indices_; };
  const auto first_cut = std::find_if(uses.begin(), uses.end(), is_cut);
  num_index_uses_.push_back(static_cast<std::uint32_t>(first_cut - uses.begin()));
  return num_arcs() - 1;
}

SlackResult search_slack(const SlackProblem& problem, double budget, const SlackLimits& limits) {
  return SlackSearch(problem, budget, limits).run(budget);
}

}  // namespace nda::bnb
