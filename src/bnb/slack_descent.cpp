#include "bnb/slack_descent.hpp"

#include <algorithm>
#include <span>
#include <utility>

// The recursion that solves a node by its parts or its choices, kept on a stack of our own, so that
// it can stop anywhere and tell what it has not seen yet.

namespace nda::bnb {

void SlackDescent::begin(const OpenSlack& open) {
  chosen_ = open.from->chosen;
  first_depth_ = open.from->depth;
  first_before_ = open.before;
  depth_ = 0;
  is_done_ = false;
  choose(open);
  nodes_[0].may_split = true;
  enter(open.before, open.budget);
}

// Makes the first node what the choice leaves.
void SlackDescent::choose(const OpenSlack& open) {
  const OpenBranching& from = *open.from;
  const std::vector<OpenArc>& choices = from.node.choices;
  Node& root = nodes_[0];
  if (choices.empty()) {
    root.arcs = from.node.arcs;
    root.rows = from.node.rows;
  } else if (open.choice == choices.size()) {
    moves_.leave(from.node, from.row.row, root);
  } else {
    const std::uint32_t arc = choices[open.choice].arc;
    moves_.occupy(arc);
    moves_.take(from.node, std::span(&arc, 1), open.budget, root);
    chosen_.push_back(arc);
    // More arcs may fit into a cut: not in every order.
    if (!moves_.is_index(from.row.row))
      moves_.drop_before(root, from.row.row, choices[open.choice]);
  }
}

void SlackDescent::run(double max_work) {
  while (!is_done_ && (moves_.work() <= max_work || moves_.stopped())) step();
}

std::vector<std::uint32_t> SlackDescent::arcs() {
  std::vector<std::uint32_t> arcs = nodes_[0].best;
  arcs.insert(arcs.end(), chosen_.begin(), chosen_.end());
  return arcs;
}

void SlackDescent::lower(double bound) {
  for (std::size_t d = 0; d <= depth_; ++d)
    nodes_[d].budget = std::min(nodes_[d].budget, bound - nodes_[d].before);
}

// The node at depth_, whose arcs and rows are there.
void SlackDescent::enter(double before, double budget) {
  Node& here = nodes_[depth_];
  here.stage = Stage::kNew;
  here.before = before;
  here.budget = budget;
}

void SlackDescent::step() {
  Node& here = nodes_[depth_];
  switch (here.stage) {
    case Stage::kNew:
      return open(here);
    case Stage::kParts:
      return next_part(here);
    case Stage::kChoices:
      return next_choice(here);
    case Stage::kLeaving:
      return close(here);
  }
}

void SlackDescent::open(Node& here) {
  here.best.clear();
  here.spent = here.least = 0;
  here.next = 0;
  const bool is_too_deep = first_depth_ + depth_ > std::size_t{kMostProofSearchDepth};
  if (!moves_.tighten(here, here.spent, here.budget, is_too_deep)) return give_back(kInfinity);
  if (here.rows.empty()) return close(here);
  if (moves_.falls_apart(here)) {
    here.stage = Stage::kParts;
    return;
  }
  here.stage = Stage::kChoices;
  here.row = moves_.narrowest(here, here.budget - here.spent);
  moves_.list_choices(here, here.row.row);
  here.least = kInfinity;
  here.may_leave = true;
}

void SlackDescent::next_part(Node& here) {
  if (here.next == here.parts.size() || !(here.spent < here.budget)) return close(here);
  Node& part = nodes_[depth_ + 1];
  here.parts.copy(here.next, here.arcs, here.rows, part.arcs, part.rows);
  part.may_split = false;
  ++depth_;
  enter(here.before + here.spent, here.budget - here.spent);
}

// What is left of the budget after a choice of this cost.  Packings that share what was chosen
// above differ from the best of them by a step as well.
double SlackDescent::limit(const Node& here, double cost) const {
  return std::min(here.budget - here.spent, here.least - step_) - cost;
}

void SlackDescent::next_choice(Node& here) {
  if (here.next < here.choices.size() && !moves_.stopped()) {
    const OpenArc choice = here.choices[here.next];
    if (const double left = limit(here, choice.reduced); left > 0) {
      moves_.occupy(choice.arc);
      moves_.take(here, std::span(&choice.arc, 1), left, nodes_[depth_ + 1]);
      ++depth_;
      return enter(here.before + here.spent + choice.reduced, left);
    }
  }
  here.stage = Stage::kLeaving;
  const double price = here.row.left * here.row.price;
  const double left = limit(here, price);
  if (moves_.stopped() || !here.may_leave || !(left > 0)) return close(here);
  moves_.leave(here, here.row.row, nodes_[depth_ + 1]);
  ++depth_;
  enter(here.before + here.spent + price, left);
}

void SlackDescent::close(Node& here) {
  const double slack = here.spent + here.least;
  if (!(slack < here.budget)) return give_back(kInfinity);
  here.best.insert(here.best.end(), here.forced.begin(), here.forced.end());
  give_back(slack);
}

// The least slack of the node at depth_, if that is within its budget; its arcs are its best.
void SlackDescent::give_back(double slack) {
  if (depth_ > 0) {
    const Node& child = nodes_[depth_];
    return receive(nodes_[--depth_], child, slack);
  }
  is_done_ = true;
  slack_ = first_before_ + slack;
}

void SlackDescent::receive(Node& here, const Node& child, double slack) {
  switch (here.stage) {
    case Stage::kParts:
      here.spent += slack;
      here.best.insert(here.best.end(), child.best.begin(), child.best.end());
      ++here.next;
      return;
    case Stage::kChoices: {
      const OpenArc choice = here.choices[here.next++];
      // More arcs may fit into a cut: not in every order.
      if (!moves_.is_index(here.row.row)) SlackMoves::drop(here, choice.arc);
      if (slack == kInfinity) return;
      here.least = choice.reduced + slack;
      here.best = child.best;
      here.best.push_back(choice.arc);
      return;
    }
    case Stage::kLeaving:
      if (slack == kInfinity) return;
      here.least = here.row.left * here.row.price + slack;
      here.best = child.best;
      return;
    case Stage::kNew:
      return;
  }
}

bool SlackDescent::give_away(std::vector<OpenSlack>& to) {
  std::vector<std::uint32_t> chosen = chosen_;
  for (std::size_t d = 0; d < depth_; ++d) {
    Node& here = nodes_[d];
    chosen.insert(chosen.end(), here.forced.begin(), here.forced.end());
    if (here.stage == Stage::kParts) {
      if (here.next + 1 < here.parts.size()) return false;
      chosen.insert(chosen.end(), here.best.begin(), here.best.end());
    } else if (here.stage == Stage::kChoices) {
      if (give_away_choices(here, chosen, first_depth_ + d + 1, to)) return true;
      chosen.push_back(here.choices[here.next].arc);
    }
  }
  return false;
}

// The choices after the one that is being searched.  `chosen`: before all of them, which are at
// `depth`.
bool SlackDescent::give_away_choices(Node& here,
                                     const std::vector<std::uint32_t>& chosen,
                                     std::size_t depth,
                                     std::vector<OpenSlack>& to) {
  const std::size_t num_before = to.size();
  const auto from = std::make_shared<OpenBranching>();
  const auto give = [&](std::size_t choice, double cost) {
    const double left = limit(here, cost);
    if (left > 0) to.push_back({from, choice, here.before + here.spent + cost, left});
    return left > 0;
  };
  std::size_t n = here.next + 1;
  while (n < here.choices.size() && give(n, here.choices[n].reduced)) ++n;
  if (here.may_leave) give(here.choices.size(), here.row.left * here.row.price);
  if (to.size() > num_before) {
    from->node.arcs = here.arcs;
    from->node.rows = here.rows;
    from->node.choices = here.choices;
    from->row = here.row;
    from->chosen = chosen;
    from->depth = depth;
  }
  here.choices.resize(here.next + 1);
  here.may_leave = false;
  return to.size() > num_before;
}

}  // namespace nda::bnb
