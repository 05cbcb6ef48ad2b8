#include "bnb/slack_search.hpp"

#include <algorithm>
#include <iterator>
#include <memory>

#include "bnb/slack_parts.hpp"
#include "core/lists.hpp"
#include "core/pause.hpp"
#include "nda/proof.hpp"

// Good multipliers leave a budget that pays for few deviations from zero slack, so what decides is
// how cheaply a node is seen through.  Five things are done at a node, all in one pass over the
// arcs that still fit and are affordable:
//
//   settle   a row that the arcs left cannot fill pays for the rest now;
//   ascend   a row all of whose arcs cost something passes the least of that on: one step of
//            coordinate ascent, inherited by the children;
//   split    what falls apart is solved part by part, each within what the others left of the
//            budget: a sum of searches where there was a product (Marinescu & Dechter 2009 call
//            it AND/OR search).  Tracking problems fall apart after a few decisions;
//   force    arcs that are the only use of a row are taken, where they are many all at once;
//   branch   on the row with the fewest uses, dear ones counting less: one of its arcs is used, or
//            none.
//
// What recursion does not pass through is kept out of its frames, which would fill the stack where
// a compiler checks them.
//
// Rounding: sums of terms below the budget err by far less than kTolerance of it, so a budget that
// much larger loses nothing.

namespace nda::bnb {
namespace {

constexpr double kTolerance = 0x1p-36;
constexpr double kStep = 0x1p-30;  // of the budget: a smaller ascent is not worth its time
constexpr double kWorkBetweenLooks = 1 << 17;
constexpr double kUseWidth = 1.5;
constexpr int kLongestPause = 3;
constexpr std::ptrdiff_t kFewForced = 16;
constexpr std::size_t kUsesOfArc = 8;  // about
constexpr std::uint32_t kMarks = 64;   // bits of a set of indices

class SlackSearch {
 public:
  SlackSearch(const SlackProblem& problem, double budget, const SlackLimits& limits)
      : problem_(problem),
        limits_(limits),
        least_step_(budget < kInfinity ? kStep * budget : 0),
        open_uses_(problem.num_rows()),
        occupied_(problem.num_rows(), 0),
        position_(problem.num_arcs(), 0),
        parts_(problem) {
    list_arcs_of_rows();
    mark_indices_of_arcs();
  }

  SlackResult run(double budget) {
    Node& root = node(0);
    for (std::uint32_t a = 0; a < problem_.num_arcs(); ++a)
      root.arcs.push_back({a, problem_.reduced(a)});
    for (std::uint32_t row = 0; row < problem_.num_rows(); ++row) {
      if (problem_.price(row) > 0 && problem_.capacity(row) > 0)
        root.rows.push_back({row, problem_.capacity(row), problem_.price(row)});
    }
    root.may_split = true;
    SlackResult result;
    result.slack = solve(0, budget < kInfinity ? budget + kTolerance * budget : budget);
    if (result.slack < kInfinity) result.arcs = root.best;
    result.complete = !stopped_;
    result.nodes = nodes_;
    result.work = work_;
    return result;
  }

 private:
  struct Node {
    std::vector<OpenArc> arcs;
    std::vector<OpenRow> rows;
    bool may_split = false;           // some arcs went since the last look
    std::vector<std::uint32_t> best;  // arcs of the best packing found
    std::vector<std::uint32_t> forced;
    std::vector<OpenArc> choices;
    Parts parts;
  };

  Node& node(std::size_t depth) {
    while (nodes_at_.size() <= depth) nodes_at_.push_back(std::make_unique<Node>());
    return *nodes_at_[depth];
  }

  void list_arcs_of_rows() {
    row_arcs_ = core::Lists<ArcUse>(problem_.num_rows(), [&](auto&& visit) {
      for (std::uint32_t a = 0; a < problem_.num_arcs(); ++a) {
        for (const RowUse use : problem_.uses(a)) visit(use.row, ArcUse{a, use.coefficient});
      }
    });
  }

  void mark_indices_of_arcs() {
    indices_.assign(problem_.num_arcs(), 0);
    for (std::uint32_t a = 0; a < problem_.num_arcs(); ++a) {
      for (const RowUse use : problem_.uses(a)) {
        if (use.row < problem_.num_indices()) indices_[a] |= std::uint64_t{1} << use.row % kMarks;
      }
    }
  }

  bool is_stopped() {
    if (nodes_ >= limits_.max_nodes || work_ > limits_.max_work) return stopped_ = true;
    ++nodes_;
    if (work_ - work_at_look_ > kWorkBetweenLooks) {
      work_at_look_ = work_;
      stopped_ = stopped_ || limits_.deadline.reached();
    }
    return stopped_;
  }

  // Least slack below the budget, or +inf; its arcs are then the node's best.
  double solve(std::size_t depth, double budget) {
    Node& here = node(depth);
    here.best.clear();
    here.forced.clear();
    double spent = 0;
    do {
      if (is_stopped() || depth > std::size_t{kMostProofSearchDepth}) {
        stopped_ = true;
        return kInfinity;
      }
      if (!settle(here, spent, budget) || !ascend(here, spent, budget)) return kInfinity;
    } while (force(here, spent, budget));
    if (!here.rows.empty()) spent += divide(depth, budget - spent);
    if (!(spent < budget)) return kInfinity;
    here.best.insert(here.best.end(), here.forced.begin(), here.forced.end());
    return spent;
  }

  double divide(std::size_t depth, double budget) {
    return falls_apart(node(depth)) ? solve_parts(depth, budget) : branch(depth, budget);
  }

  // Takes arcs that are the only use of a row: the first one where there are few such rows, as the
  // ascent that follows is worth its time, else all that fit together.  Returns whether there were
  // any.
  [[gnu::noinline]] bool force(Node& here, double& spent, double budget) {
    const auto forces = [&](const OpenRow& row) { return num_uses(row, budget - spent) == 1; };
    const auto num_rows = std::count_if(here.rows.begin(), here.rows.end(), forces);
    if (num_rows == 0) return false;
    const std::size_t before = here.forced.size();
    if (num_rows <= kFewForced) {
      const OpenRow row = narrowest(here, budget - spent);
      if (forces(row)) force(here, row, spent);
    } else {
      for (const OpenRow& row : here.rows) {
        if (forces(row)) force(here, row, spent);
      }
    }
    const auto forced = std::span(here.forced).subspan(before);
    if (!forced.empty()) take(here, forced, budget - spent, here);
    return !forced.empty();
  }

  // Occupies the rows of a row's only arc, if it fits.
  void force(Node& here, const OpenRow& row, double& spent) {
    const OpenArc only = only_arc(here, row.row);
    if (!fits(only.arc)) return;
    occupy(only.arc);
    here.forced.push_back(only.arc);
    spent += only.reduced;
  }

  // Of a row with one open arc.
  OpenArc only_arc(Node& here, std::uint32_t row) {
    OpenArc only{};
    for_each_open(here, row, [&](const OpenArc& arc, std::uint32_t) { only = arc; });
    return only;
  }

  // Drops what the budget does not pay for, charges rows for what nothing is left to fill.
  // Returns whether the budget is kept.
  [[gnu::noinline]] bool settle(Node& here, double& spent, double budget) {
    for (bool again = true; again;) {
      if (!(spent < budget)) return false;
      count(here, budget - spent);
      again = false;
      for (OpenRow& row : here.rows) {
        if (open_uses_[row.row].count >= row.left) continue;
        spent += (row.left - open_uses_[row.row].count) * row.price;
        if (!(spent < budget)) return false;
        row.left = open_uses_[row.row].count;
        again = true;
      }
      std::erase_if(here.rows, [](const OpenRow& row) { return row.left == 0; });
    }
    return true;
  }

  void count(Node& here, double left) {
    for (const OpenRow& row : here.rows) {
      open_uses_[row.row] = {};
    }
    const std::size_t before = here.arcs.size();
    std::erase_if(here.arcs, [&](const OpenArc& arc) { return !(arc.reduced < left); });
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

  // Lowers prices and reduced costs by what every use of a row costs.
  [[gnu::noinline]] bool ascend(Node& here, double& spent, double budget) {
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
    std::erase_if(here.rows, [](const OpenRow& row) { return row.price <= 0; });
    return spent < budget;
  }

  double least_share(Node& here, std::uint32_t row) {
    double least = kInfinity;
    for_each_open(here, row, [&](const OpenArc& arc, std::uint32_t coefficient) {
      least = std::min(least, arc.reduced / coefficient);
    });
    return least;
  }

  // The open arcs of a row, ascending, as long as none was dropped since they were counted: by way
  // of all its arcs, or of all open ones, whichever are fewer.
  template <typename Visit>
  void for_each_open(Node& here, std::uint32_t row, Visit&& visit) {
    const bool is_index = row < problem_.num_indices();
    const std::span<const ArcUse> of_row = row_arcs_[row];
    if (here.arcs.size() * (is_index ? 1 : kUsesOfArc) < of_row.size()) {
      const std::uint64_t mark = is_index ? std::uint64_t{1} << row % kMarks : 0;
      for (OpenArc& arc : here.arcs) {
        if ((indices_[arc.arc] & mark) != mark) continue;
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

  // Looking for parts costs as much as a node: less often where it keeps failing.
  [[gnu::noinline]] bool falls_apart(Node& here) {
    if (!here.may_split) return false;
    here.may_split = false;
    if (pause_.skip()) return false;
    const bool split = parts_.split(here.arcs, here.rows, here.parts);
    pause_.note(split);
    return split;
  }

  double solve_parts(std::size_t depth, double budget) {
    Node& here = node(depth);
    double spent = 0;
    for (std::size_t p = 0; p < here.parts.size(); ++p) {
      Node& part = node(depth + 1);
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
    Node& here = node(depth);
    const OpenRow row = narrowest(here, budget);
    list_choices(here, row.row);
    double least = kInfinity;
    for (const OpenArc choice : here.choices) {
      const double limit = std::min(budget, least) - choice.reduced;
      if (stopped_ || !(limit > 0)) break;
      occupy(choice.arc);
      take(here, std::span(&choice.arc, 1), limit, node(depth + 1));
      const double slack = solve(depth + 1, limit);
      if (slack < limit) {
        least = choice.reduced + slack;
        here.best = node(depth + 1).best;
        here.best.push_back(choice.arc);
      }
      // More arcs may fit into a cut: not in every order.
      if (row.row >= problem_.num_indices()) drop(here, choice.arc);
    }
    const double price = row.left * row.price;
    const double limit = std::min(budget, least) - price;
    if (stopped_ || !(limit > 0)) return least;
    leave(here, row.row, node(depth + 1));
    const double slack = solve(depth + 1, limit);
    if (!(slack < limit)) return least;
    here.best = node(depth + 1).best;
    return price + slack;
  }

  // The affordable uses of a row, leaving it included.
  std::uint32_t num_uses(const OpenRow& row, double budget) const {
    return open_uses_[row.row].count + (row.left * row.price < budget ? 1 : 0);
  }

  // The row with the fewest uses, dear ones counting less: below them not much will be left.
  OpenRow narrowest(const Node& here, double budget) const {
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

  // 0: the arc is not in the row.
  std::uint32_t coefficient_in(std::uint32_t arc, std::uint32_t row) const {
    for (const RowUse use : problem_.uses(arc)) {
      if (use.row == row) return use.coefficient;
    }
    return 0;
  }

  bool is_in(std::uint32_t arc, std::uint32_t row) const { return coefficient_in(arc, row) > 0; }

  [[gnu::noinline]] void list_choices(Node& here, std::uint32_t row) {
    here.choices.clear();
    for_each_open(
        here, row, [&](const OpenArc& arc, std::uint32_t) { here.choices.push_back(arc); });
    std::sort(here.choices.begin(), here.choices.end(), [](const OpenArc& a, const OpenArc& b) {
      return a.reduced != b.reduced ? a.reduced < b.reduced : a.arc < b.arc;
    });
  }

  // What is left of a node when arcs are used that occupy their rows, and `budget` is left; `next`
  // may be `here`.
  [[gnu::noinline]] void take(const Node& here,
                              std::span<const std::uint32_t> arcs,
                              double budget,
                              Node& next) {
    copy_if(here.arcs, next.arcs, [&](const OpenArc& other) {
      return other.reduced < budget && fits(other.arc);
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

  void occupy(std::uint32_t arc) {
    for (const RowUse use : problem_.uses(arc)) occupied_[use.row] += use.coefficient;
    occupied_marks_ |= indices_[arc];
  }

  // Whether all indices of an arc are free.
  bool fits(std::uint32_t arc) const {
    if ((indices_[arc] & occupied_marks_) == 0) return true;
    if (problem_.num_indices() <= kMarks) return false;
    for (const RowUse use : problem_.index_uses(arc)) {
      if (occupied_[use.row] != 0) return false;
    }
    return true;
  }

  // What is left of a node when a row is not used any more; `next` may be `here`.
  [[gnu::noinline]] void leave(const Node& here, std::uint32_t row, Node& next) const {
    copy_if(here.arcs, next.arcs, [&](const OpenArc& arc) { return !is_in(arc.arc, row); });
    copy_if(here.rows, next.rows, [&](const OpenRow& other) { return other.row != row; });
    next.may_split = true;
  }

  template <typename T, typename Keep>
  static void copy_if(const std::vector<T>& from, std::vector<T>& to, Keep&& keep) {
    if (&from == &to) {
      std::erase_if(to, [&](const T& item) { return !keep(item); });
      return;
    }
    to.clear();
    std::copy_if(from.begin(), from.end(), std::back_inserter(to), keep);
  }

  static void drop(Node& here, std::uint32_t arc) {
    std::erase_if(here.arcs, [&](const OpenArc& other) { return other.arc == arc; });
  }

  const SlackProblem& problem_;
  const SlackLimits& limits_;
  const double least_step_;
  struct ArcUse {
    std::uint32_t arc;
    std::uint32_t coefficient;
  };
  // The open arcs of a row.
  struct OpenUses {
    double least = kInfinity;  // reduced cost
    double sum = 0;            // of reduced costs
    std::uint32_t count = 0;   // sum of coefficients
  };
  core::Lists<ArcUse> row_arcs_;         // by row
  std::vector<std::uint64_t> indices_;   // [arc]: its indices, modulo kMarks
  std::vector<OpenUses> open_uses_;      // [row]
  std::vector<std::uint32_t> occupied_;  // [row]: by the arcs being taken, else 0
  std::uint64_t occupied_marks_ = 0;     // indices of these arcs
  std::vector<std::uint32_t> position_;  // [arc]: where it was in the list counted last
  PartFinder parts_;
  core::Pause pause_{kLongestPause};
  std::vector<std::unique_ptr<Node>> nodes_at_;  // by depth
  std::int64_t nodes_ = 0;
  double work_ = 0;
  double work_at_look_ = 0;
  bool stopped_ = false;
};

}  // namespace

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
