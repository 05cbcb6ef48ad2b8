#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <span>
#include <vector>

#include "bnb/slack_parts.hpp"
#include "bnb/slack_search.hpp"
#include "core/lists.hpp"
#include "core/pause.hpp"
#include "nda/proof.hpp"
#include "nda/solution.hpp"

// What is done at a node of a search within the slack, whatever it is looking for (slack_search,
// kbest/slack_ranking).  All of it keeps every packing within the budget, with its slack:
//
//   settle   a row that the arcs left cannot fill pays for the rest now;
//   ascend   a row all of whose arcs cost something passes the least of that on: one step of
//            coordinate ascent, inherited by the children;
//   force    arcs that are the only use of a row are taken, where they are many all at once;
//   split    what falls apart is solved part by part;
//   take, leave, drop   what is left for a child.
//
// What recursion does not pass through is kept out of its frames, which would fill the stack where
// a compiler checks them.

namespace nda::bnb {

/// Rows of price 0 that are indices: where only the least slack matters, nothing is lost without
/// them; whoever wants other packings needs them.
enum class FreeRows { kDrop, kKeep };

struct SlackNode {
  std::vector<OpenArc> arcs;
  std::vector<OpenRow> rows;
  bool may_split = false;  ///< some arcs went since the last look
  std::vector<std::uint32_t> forced;
  std::vector<OpenArc> choices;
  Parts parts;
};

/// The nodes from the root down, kept between visits; they do not move.
template <typename Node>
class NodesByDepth {
 public:
  Node& operator[](std::size_t depth) {
    while (nodes_.size() <= depth) nodes_.push_back(std::make_unique<Node>());
    return *nodes_[depth];
  }

 private:
  std::vector<std::unique_ptr<Node>> nodes_;
};

/// The moves of a search within the slack, its limits and its counts.
class SlackMoves {
 public:
  SlackMoves(const SlackProblem& problem,
             double budget,
             const SlackLimits& limits,
             FreeRows free_rows)
      : problem_(problem),
        limits_(limits),
        free_rows_(free_rows),
        least_step_(budget < kInfinity ? kStep * budget : 0),
        lists_(std::make_shared<const ArcLists>(problem)),
        open_uses_(problem.num_rows()),
        occupied_(problem.num_rows(), 0),
        position_(problem.num_arcs(), 0),
        parts_(problem) {}

  /// All arcs and rows.
  void open(SlackNode& root) const {
    root.arcs.reserve(problem_.num_arcs());
    root.rows.reserve(problem_.num_rows());
    for (std::uint32_t a = 0; a < problem_.num_arcs(); ++a)
      root.arcs.push_back({a, problem_.reduced(a)});
    for (std::uint32_t row = 0; row < problem_.num_rows(); ++row) {
      if ((problem_.price(row) > 0 || keeps(row)) && problem_.capacity(row) > 0)
        root.rows.push_back({row, problem_.capacity(row), problem_.price(row)});
    }
    root.may_split = true;
  }

  /// The same problem and limits, nothing done yet.  What stays as it is they share.
  SlackMoves fork() const {
    SlackMoves other = *this;
    other.nodes_ = 0;
    other.work_ = other.work_at_look_ = 0;
    other.fixing_ = {};
    return other;
  }

  bool stopped() const { return stopped_; }
  void look_at_clock() { stopped_ = stopped_ || limits_.deadline.reached(); }
  void stop() { stopped_ = true; }
  /// Stops after so many nodes in all.
  void limit_nodes(std::int64_t max_nodes) { max_nodes_ = max_nodes; }
  double step() const { return limits_.step; }
  bool is_index(std::uint32_t row) const { return row < problem_.num_indices(); }
  std::int64_t nodes() const { return nodes_; }
  double work() const { return work_; }
  /// What went beside branching: what the budget does not pay for, forced arcs, parts.
  const FixingYield& fixing() const { return fixing_; }
  /// What the search does besides.
  void add_work(std::size_t work) { work_ += static_cast<double>(work); }

  /// By how much, at least, whatever was left out exceeded the budget: no packing that was pruned
  /// for its slack has less than the first budget and that.
  double excess() const { return excess_; }
  /// The search itself leaves something out that exceeds the budget by so much.
  void leave_out(double excess) { excess_ = std::min(excess_, excess); }

  /// Settles, ascends and forces until nothing moves, from nothing spent and nothing forced.
  /// Returns false where the budget is not kept or a limit strikes, also that of the depth.
  [[gnu::noinline]] bool tighten(SlackNode& here, double& spent, double budget, bool is_too_deep) {
    here.forced.clear();
    do {
      if (is_stopped() || is_too_deep) {
        stopped_ = true;
        return false;
      }
      if (!settle(here, spent, budget) || !ascend(here, spent, budget)) return false;
    } while (force(here, spent, budget));
    return true;
  }

  /// Looking for parts costs as much as a node: less often where it keeps failing.
  [[gnu::noinline]] bool falls_apart(SlackNode& here) {
    if (!here.may_split) return false;
    here.may_split = false;
    if (pause_.skip()) return false;
    const bool split = parts_.split(here.arcs, here.rows, here.parts);
    pause_.note(split);
    if (split) {
      ++fixing_.splits;
      fixing_.parts += here.parts.size();
    }
    return split;
  }

  /// The affordable uses of a row, leaving it included.
  std::uint32_t num_uses(const OpenRow& row, double budget) const {
    return open_uses_[row.row].count + (row.left * row.price < budget ? 1 : 0);
  }

  /// The row with the fewest uses, dear ones counting less: below them not much will be left.
  OpenRow narrowest(const SlackNode& here, double budget) const {
    const auto width = [&](const OpenRow& row) {
      const double costs = open_uses_[row.row].sum + std::min(budget, row.left * row.price);
      return kUseWidth * num_uses(row, budget) - costs / budget;
    };
    OpenRow best = here.rows.front();
    double least = width(best);
    for (const OpenRow& row : here.rows) {
      const double here_width = num_uses(row, budget) <= 1 ? 0 : width(row);
      if (here_width >= least) continue;
      least = here_width;
      best = row;
    }
    return best;
  }

  [[gnu::noinline]] void list_choices(SlackNode& here, std::uint32_t row) {
    here.choices.clear();
    for_each_open(
        here, row, [&](const OpenArc& arc, std::uint32_t) { here.choices.push_back(arc); });
    std::sort(here.choices.begin(), here.choices.end(), comes_before);
  }

  /// What is left of a node when arcs are used that occupy their rows, and `budget` is left; `next`
  /// may be `here`.
  [[gnu::noinline]] void take(const SlackNode& here,
                              std::span<const std::uint32_t> arcs,
                              double budget,
                              SlackNode& next) {
    copy_if(here.arcs, next.arcs, [&](const OpenArc& other) {
      return keeps(budget, other) && fits(other.arc);
    });
    next.rows = here.rows;
    for (OpenRow& row : next.rows) row.left -= std::min(row.left, occupied_[row.row]);
    std::erase_if(next.rows, [](const OpenRow& row) { return row.left == 0; });
    for (const std::uint32_t arc : arcs) {
      for (const RowUse use : problem_.uses(arc)) occupied_[use.row] = 0;
    }
    occupied_marks_ = 0;
    next.may_split = true;
  }

  /// By an arc that is taken next.
  void occupy(std::uint32_t arc) {
    for (const RowUse use : problem_.uses(arc)) occupied_[use.row] += use.coefficient;
    occupied_marks_ |= lists_->indices[arc];
  }

  /// What is left of a node when a row is not used any more; `next` may be `here`.
  [[gnu::noinline]] void leave(const SlackNode& here, std::uint32_t row, SlackNode& next) const {
    copy_if(here.arcs, next.arcs, [&](const OpenArc& arc) { return !is_in(arc.arc, row); });
    copy_if(here.rows, next.rows, [&](const OpenRow& other) { return other.row != row; });
    next.may_split = true;
  }

  static void drop(SlackNode& here, std::uint32_t arc) {
    std::erase_if(here.arcs, [&](const OpenArc& other) { return other.arc == arc; });
  }

  /// All choices of a row that are listed before this one.
  void drop_before(SlackNode& here, std::uint32_t row, const OpenArc& choice) const {
    std::erase_if(here.arcs, [&](const OpenArc& other) {
      return comes_before(other, choice) && is_in(other.arc, row);
    });
  }

 private:
  static constexpr double kStep = 0x1p-30;  // of the budget: a smaller ascent is not worth its time
  static constexpr double kWorkBetweenLooks = 1 << 17;
  static constexpr double kUseWidth = 1.5;
  static constexpr int kLongestPause = 3;
  static constexpr std::ptrdiff_t kFewForced = 16;
  static constexpr std::size_t kUsesOfArc = 8;  // about
  static constexpr std::uint32_t kMarks = 64;   // bits of a set of indices

  struct ArcUse {
    std::uint32_t arc;
    std::uint32_t coefficient;
  };

  struct ArcLists {
    explicit ArcLists(const SlackProblem& problem)
        : of_row(problem.num_rows(),
                 [&](auto&& visit) {
                   for (std::uint32_t a = 0; a < problem.num_arcs(); ++a) {
                     for (const RowUse use : problem.uses(a))
                       visit(use.row, ArcUse{a, use.coefficient});
                   }
                 }),
          indices(problem.num_arcs(), 0) {
      for (std::uint32_t a = 0; a < problem.num_arcs(); ++a) {
        for (const RowUse use : problem.index_uses(a))
          indices[a] |= std::uint64_t{1} << use.row % kMarks;
      }
    }

    core::Lists<ArcUse> of_row;
    std::vector<std::uint64_t> indices;  // [arc]: its indices, modulo kMarks
  };

  static bool comes_before(const OpenArc& a, const OpenArc& b) {
    return a.reduced != b.reduced ? a.reduced < b.reduced : a.arc < b.arc;
  }

  bool keeps(std::uint32_t row) const { return free_rows_ == FreeRows::kKeep && is_index(row); }

  // Whether a budget pays for an arc; else it is fixed to zero.
  bool keeps(double budget, const OpenArc& arc) {
    const bool keeps = affords(budget, arc.reduced);
    fixing_.dropped += !keeps;
    return keeps;
  }

  // Whether a budget pays for so much slack; else that is left out.
  bool affords(double budget, double slack) {
    if (slack < budget) return true;
    leave_out(slack - budget);
    return false;
  }

  // Counts a node; looks at the limits.
  bool is_stopped() {
    if (stopped_ || nodes_ >= max_nodes_ || work_ > limits_.max_work) return stopped_ = true;
    ++nodes_;
    if (work_ - work_at_look_ > kWorkBetweenLooks) {
      work_at_look_ = work_;
      stopped_ = stopped_ || limits_.deadline.reached();
    }
    return stopped_;
  }

  // Drops what the budget does not pay for, charges rows for what nothing is left to fill.
  // Returns whether the budget is kept.
  [[gnu::noinline]] bool settle(SlackNode& here, double& spent, double budget) {
    for (bool again = true; again;) {
      if (!affords(budget, spent)) return false;
      count(here, budget - spent);
      again = false;
      for (OpenRow& row : here.rows) {
        if (open_uses_[row.row].count >= row.left) continue;
        spent += (row.left - open_uses_[row.row].count) * row.price;
        if (!affords(budget, spent)) return false;
        row.left = open_uses_[row.row].count;
        again = true;
      }
      std::erase_if(here.rows, [](const OpenRow& row) { return row.left == 0; });
    }
    return true;
  }

  // Lowers prices and reduced costs by what every use of a row costs.
  [[gnu::noinline]] bool ascend(SlackNode& here, double& spent, double budget) {
    const auto pays = [&](const OpenRow& row) { return open_uses_[row.row].least > least_step_; };
    if (std::none_of(here.rows.begin(), here.rows.end(), pays)) return true;
    for (OpenRow& row : here.rows) {
      if (!pays(row)) continue;
      const double step = std::min(row.price, least_share(here, row.row));
      if (!(step > least_step_)) continue;
      for_each_open(here, row.row, [&](OpenArc& arc, std::uint32_t coefficient) {
        arc.reduced = std::max(0.0, arc.reduced - step * coefficient);
      });
      row.price -= step;
      spent += step * row.left;
      if (!(spent < budget)) break;
    }
    std::erase_if(here.rows, [&](const OpenRow& row) { return row.price <= 0 && !keeps(row.row); });
    return affords(budget, spent);
  }

  // Takes arcs that are the only use of a row: the first one where there are few such rows, as the
  // ascent that follows is worth its time, else all that fit together.  Returns whether there were
  // any.
  [[gnu::noinline]] bool force(SlackNode& here, double& spent, double budget) {
    const auto forces = [&](const OpenRow& row) { return num_uses(row, budget - spent) == 1; };
    const auto num_rows = std::count_if(here.rows.begin(), here.rows.end(), forces);
    if (num_rows == 0) return false;
    const std::size_t before = here.forced.size();
    if (num_rows <= kFewForced) {
      const OpenRow row = narrowest(here, budget - spent);
      if (forces(row)) force(here, row, budget, spent);
    } else {
      for (const OpenRow& row : here.rows) {
        if (forces(row)) force(here, row, budget, spent);
      }
    }
    const auto forced = std::span(here.forced).subspan(before);
    if (!forced.empty()) take_forced(here, forced, budget - spent);
    return !forced.empty();
  }

  void take_forced(SlackNode& here, std::span<const std::uint32_t> forced, double budget) {
    const std::size_t dropped = fixing_.dropped + here.arcs.size() - forced.size();
    take(here, forced, budget, here);
    fixing_.dropped = dropped - here.arcs.size();
    fixing_.taken += forced.size();
  }

  void count(SlackNode& here, double left) {
    for (const OpenRow& row : here.rows) {
      open_uses_[row.row] = {};
    }
    const std::size_t before = here.arcs.size();
    std::erase_if(here.arcs, [&](const OpenArc& arc) { return !keeps(left, arc); });
    here.may_split = here.may_split || here.arcs.size() < before;
    std::size_t work = here.rows.size();
    for (std::uint32_t i = 0; i < here.arcs.size(); ++i) {
      const OpenArc arc = here.arcs[i];
      work += problem_.uses(arc.arc).size();
      position_[arc.arc] = i;
      for (const RowUse use : problem_.uses(arc.arc)) {
        OpenUses& uses = open_uses_[use.row];
        uses.count += use.coefficient;
        uses.least = std::min(uses.least, arc.reduced);
        uses.sum += arc.reduced;
      }
    }
    work_ += static_cast<double>(work);
  }

  double least_share(SlackNode& here, std::uint32_t row) {
    double least = kInfinity;
    for_each_open(here, row, [&](const OpenArc& arc, std::uint32_t coefficient) {
      least = std::min(least, arc.reduced / coefficient);
    });
    return least;
  }

  // The open arcs of a row, ascending, as long as none was dropped since they were counted: by way
  // of all its arcs, or of all open ones, whichever are fewer.
  template <typename Visit>
  void for_each_open(SlackNode& here, std::uint32_t row, Visit&& visit) {
    const std::span<const ArcUse> of_row = lists_->of_row[row];
    if (here.arcs.size() * (is_index(row) ? 1 : kUsesOfArc) < of_row.size()) {
      const std::uint64_t mark = is_index(row) ? std::uint64_t{1} << row % kMarks : 0;
      for (OpenArc& arc : here.arcs) {
        if ((lists_->indices[arc.arc] & mark) != mark) continue;
        if (const std::uint32_t coefficient = coefficient_in(arc.arc, row); coefficient > 0)
          visit(arc, coefficient);
      }
      return;
    }
    for (const ArcUse& use : of_row) {
      const std::uint32_t position = position_[use.arc];
      if (position < here.arcs.size() && here.arcs[position].arc == use.arc)
        visit(here.arcs[position], use.coefficient);
    }
  }

  // Occupies the rows of a row's only arc, if it fits: leaving it is beyond the budget.
  void force(SlackNode& here, const OpenRow& row, double budget, double& spent) {
    const OpenArc only = only_arc(here, row.row);
    if (!fits(only.arc)) return;
    affords(budget - spent, row.left * row.price);
    occupy(only.arc);
    here.forced.push_back(only.arc);
    spent += only.reduced;
  }

  // Of a row with one open arc.
  OpenArc only_arc(SlackNode& here, std::uint32_t row) {
    OpenArc only{};
    for_each_open(here, row, [&](const OpenArc& arc, std::uint32_t) { only = arc; });
    return only;
  }

  // 0: the arc is not in the row.
  std::uint32_t coefficient_in(std::uint32_t arc, std::uint32_t row) const {
    for (const RowUse use : problem_.uses(arc)) {
      if (use.row == row) return use.coefficient;
    }
    return 0;
  }

  bool is_in(std::uint32_t arc, std::uint32_t row) const { return coefficient_in(arc, row) > 0; }

  // Whether all indices of an arc are free.
  bool fits(std::uint32_t arc) const {
    if ((lists_->indices[arc] & occupied_marks_) == 0) return true;
    if (problem_.num_indices() <= kMarks) return false;
    for (const RowUse use : problem_.index_uses(arc)) {
      if (occupied_[use.row] != 0) return false;
    }
    return true;
  }

  template <typename T, typename Keep>
  static void copy_if(const std::vector<T>& from, std::vector<T>& to, Keep&& keep) {
    if (&from == &to) {
      std::erase_if(to, [&](const T& item) { return !keep(item); });
      return;
    }
    to.clear();
    to.reserve(from.size());
    std::copy_if(from.begin(), from.end(), std::back_inserter(to), keep);
  }

  const SlackProblem& problem_;
  const SlackLimits& limits_;
  const FreeRows free_rows_;
  const double least_step_;
  // The open arcs of a row.
  struct OpenUses {
    double least = kInfinity;  // reduced cost
    double sum = 0;            // of reduced costs
    std::uint32_t count = 0;   // sum of coefficients
  };
  std::shared_ptr<const ArcLists> lists_;
  std::vector<OpenUses> open_uses_;      // [row]
  std::vector<std::uint32_t> occupied_;  // [row]: by the arcs being taken, else 0
  std::uint64_t occupied_marks_ = 0;     // indices of these arcs
  std::vector<std::uint32_t> position_;  // [arc]: where it was in the list counted last
  PartFinder parts_;
  core::Pause pause_{kLongestPause};
  std::int64_t max_nodes_ = limits_.max_nodes;
  std::int64_t nodes_ = 0;
  double work_ = 0;
  double work_at_look_ = 0;
  bool stopped_ = false;
  double excess_ = kInfinity;
  FixingYield fixing_;
};

}  // namespace nda::bnb
