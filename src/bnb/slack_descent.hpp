#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "bnb/slack_moves.hpp"

namespace nda::bnb {

/// A node whose choices somebody else is to search: what is left where some arcs are chosen.
struct OpenBranching {
  SlackNode node;  ///< its choices are arcs of `row`
  OpenRow row = {};
  std::vector<std::uint32_t> chosen;
  std::size_t depth = 0;  ///< of the choices in the tree
};

/// One of its choices.  All of them share the node, so that many hold no more than one: what a
/// choice leaves of it is worked out by whoever searches it.
struct OpenSlack {
  std::shared_ptr<const OpenBranching> from;
  std::size_t choice = 0;  ///< their number = to use none of the row's arcs; without any, all
  double before = 0;       ///< slack of what is chosen then
  double budget = 0;       ///< for the rest
};

/// Depth first search for the packing of least slack, which can be interrupted and can give a part
/// of what it has not seen yet away.
class SlackDescent {
 public:
  explicit SlackDescent(SlackMoves moves) : moves_(std::move(moves)), step_(moves_.step()) {}

  /// Starts anew.
  void begin(const OpenSlack& open);
  /// Goes on until it is done, or its moves have done so much work in all.  Once the moves are
  /// stopped it is soon done, with the best of what it has seen.
  void run(double max_work);
  bool is_done() const { return is_done_; }

  /// Of a search that is done: slack and arcs of the best packing, with those that were chosen
  /// before; +inf = none within the budget.
  double slack() const { return slack_; }
  std::vector<std::uint32_t> arcs();

  /// Packings of the whole problem are to have less slack than this.
  void lower(double bound);
  /// Appends what is left to choose at the branching nearest to the root that has a choice left,
  /// and forgets it.  Returns whether there was anything: nothing below parts of a node that are
  /// not the last.
  bool give_away(std::vector<OpenSlack>& to);

  SlackMoves& moves() { return moves_; }
  const SlackMoves& moves() const { return moves_; }

 private:
  // Where a node stands: not seen yet, at a part or a choice, at the last choice of a branching, to
  // use none of the row's arcs.
  enum class Stage { kNew, kParts, kChoices, kLeaving };

  struct Node : SlackNode {
    Stage stage;
    double before;     // slack of all that was chosen above, in this search and before
    double budget;     // for what is left
    double spent;      // of it: tightening, and the parts that were solved
    double least;      // of the choices so far; 0 without a branching
    std::size_t next;  // part, or choice
    OpenRow row;       // that is branched on
    bool may_leave;    // its last choice was not given away
    std::vector<std::uint32_t> best;  // arcs of the best packing found
  };

  void choose(const OpenSlack& open);
  void enter(double before, double budget);
  void step();
  void open(Node& here);
  void next_part(Node& here);
  void next_choice(Node& here);
  void close(Node& here);
  void give_back(double slack);
  void receive(Node& here, const Node& child, double slack);
  double limit(const Node& here, double cost) const;
  bool give_away_choices(Node& here,
                         const std::vector<std::uint32_t>& chosen,
                         std::size_t depth,
                         std::vector<OpenSlack>& to);

  SlackMoves moves_;
  const double step_;  // SlackLimits::step
  NodesByDepth<Node> nodes_;
  std::vector<std::uint32_t> chosen_;
  std::size_t first_depth_ = 0;
  double first_before_ = 0;
  std::size_t depth_ = 0;
  bool is_done_ = true;
  double slack_ = kInfinity;
};

}  // namespace nda::bnb
