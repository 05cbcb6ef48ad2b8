#include "core/proof_search.hpp"

#include <cmath>
#include <limits>
#include <utility>

// The checker's own search.  It reckons in integers: units so small that the budget is 2^48 of
// them (no smaller than the least double), every cost rounded down.  So nothing is rounded on the
// way, and the sum of what was lost is on the safe side.
//
// The search is that of bnb/slack_search.cpp, written a second time: it must not take much longer.
// Its tricks lose nothing.  A row that the arcs left cannot fill pays for the rest.  Lowering the
// price of a row by d and the costs of its arcs by d times their coefficients lowers every choice
// by d times the capacity left.  Arcs that share nothing, not even over others, are chosen
// independently.

namespace nda::core {
namespace {

using Units = std::int64_t;

constexpr int kBudgetExponent = 48;
constexpr double kLeastUnit = std::numeric_limits<double>::denorm_min();
constexpr int kLongestPause = 3;
constexpr std::ptrdiff_t kFewForced = 16;
constexpr std::size_t kMostHeld = 200'000'000;  // arcs in all states at once
constexpr double kChoiceWidth = 1.5;
constexpr std::uint32_t kMostCapacity = 255;
constexpr std::uint32_t kUnlabelled = std::numeric_limits<std::uint32_t>::max();

struct Arc {
  std::uint32_t id;
  Units rise;
};

struct Row {
  std::uint32_t id;
  std::uint32_t left;
  Units price;
};

struct State {
  std::vector<Arc> arcs;
  std::vector<Row> rows;
};

class ProofSearch {
 public:
  ProofSearch(const SearchTask& task, double budget, double& work, double most_work)
      : task_(task),
        work_(work),
        most_work_(most_work),
        unit_(std::max(kLeastUnit, std::ldexp(1.0, std::ilogb(budget) - kBudgetExponent))),
        limit_(static_cast<Units>(std::ceil(budget / unit_))),
        arcs_of_(task.rows.size()),
        filled_(task.rows.size(), 0),
        cost_(task.rows.size(), 0),
        least_(task.rows.size(), 0),
        marked_(task.rows.size(), 0),
        label_(task.rows.size(), 0),
        where_(task.rise.size(), 0) {}

  double run() {
    State state;
    for (std::uint32_t a = 0; a < task_.rise.size(); ++a) {
      state.arcs.push_back({a, units(task_.rise[a])});
      for (const SearchEntry entry : task_.entries[a])
        arcs_of_[entry.row].push_back({a, entry.coefficient});
    }
    for (std::uint32_t r = 0; r < task_.rows.size(); ++r) {
      if (task_.rows[r].capacity > kMostCapacity)
        throw ProofFault{"a cut of the search is too wide"};
      state.rows.push_back({r, task_.rows[r].capacity, units(task_.rows[r].price)});
    }
    return static_cast<double>(least(std::move(state), limit_, 0)) * unit_;
  }

 private:
  struct Member {
    std::uint32_t arc;
    std::uint32_t coefficient;
  };

  Units units(double cost) const {
    const double count = std::floor(cost / unit_);
    return count < static_cast<double>(limit_) ? static_cast<Units>(count) : limit_;
  }

  // The least cost of a choice, or the limit if none costs less.
  Units least(State state, Units limit, int depth) {
    const std::size_t size = state.arcs.size();
    held_ += size;
    if (depth > kMostProofSearchDepth) throw ProofFault{"the search is too deep"};
    if (held_ > kMostHeld) throw ProofFault{"the search takes too much memory"};
    const Units result = explore(std::move(state), limit, depth);
    held_ -= size;
    return result;
  }

  Units explore(State state, Units limit, int depth) {
    Units paid = 0;
    do {
      if (!pay_unfillable(state, paid, limit) || !pay_common(state, paid, limit)) return limit;
    } while (use_only_choices(state, paid, limit));
    if (state.rows.empty() || paid >= limit) return std::min(paid, limit);
    const std::size_t num_parts = label_parts(state);
    if (num_parts < 2) return std::min(limit, paid + branch(state, limit - paid, depth + 1));
    std::vector<State> parts = divide(state, num_parts);
    for (State& part : parts) {
      paid += least(std::move(part), limit - paid, depth + 1);
      if (paid >= limit) return limit;
    }
    return paid;
  }

  // A row that must not be left has one arc: that is used.  One after the other, with what lowers
  // all choices in between, or many at once, as long as they share no index.  Returns whether there
  // were any.
  bool use_only_choices(State& state, Units& paid, Units limit) {
    const auto is_forced = [&](const Row& row) {
      return filled_[row.id] == 1 && row.left * row.price >= limit - paid;
    };
    const auto count = std::count_if(state.rows.begin(), state.rows.end(), is_forced);
    std::vector<std::uint32_t> used;
    for (const Row& row : state.rows) {
      if (!is_forced(row)) continue;
      const Arc only = users(state, row.id).front();
      if (meets_marks(only.id)) continue;
      mark(only.id);
      used.push_back(only.id);
      paid = std::min(limit, paid + only.rise);
      if (count <= kFewForced) break;
    }
    if (!used.empty()) state = with(state, used);
    return !used.empty();
  }

  Units branch(State& state, Units limit, int depth) {
    const Row row = tightest(state, limit);
    for (const Arc choice : users(state, row.id)) {
      if (choice.rise >= limit) break;
      mark(choice.id);
      limit = choice.rise + least(with(state, {choice.id}), limit - choice.rise, depth);
      // Other orders of several arcs in a cut are no other choices.
      if (row.id >= task_.num_indices)
        std::erase_if(state.arcs, [&](const Arc& arc) { return arc.id == choice.id; });
    }
    const Units price = row.left * row.price;
    if (price < limit) limit = price + least(without(state, row.id), limit - price, depth);
    return limit;
  }

  void fill(const State& state) {
    std::size_t work = 1 + state.rows.size() + state.arcs.size();
    for (const Row& row : state.rows) {
      cost_[row.id] = 0;
      filled_[row.id] = 0;
      least_[row.id] = limit_;
    }
    for (std::uint32_t i = 0; i < state.arcs.size(); ++i) {
      const Arc arc = state.arcs[i];
      where_[arc.id] = i;
      work += task_.entries[arc.id].size();
      for (const SearchEntry entry : task_.entries[arc.id]) {
        filled_[entry.row] += entry.coefficient;
        cost_[entry.row] += static_cast<double>(arc.rise);
        least_[entry.row] = std::min(least_[entry.row], arc.rise);
      }
    }
    spend(work);
  }

  // False where the limit is reached.
  bool pay_unfillable(State& state, Units& paid, Units limit) {
    for (bool again = true; again && paid < limit;) {
      again = false;
      std::erase_if(state.arcs, [&](const Arc& arc) { return arc.rise >= limit - paid; });
      fill(state);
      for (Row& row : state.rows) {
        if (filled_[row.id] >= row.left) continue;
        paid = std::min(limit, paid + (row.left - filled_[row.id]) * row.price);
        row.left = static_cast<std::uint32_t>(filled_[row.id]);
        again = true;
      }
      std::erase_if(state.rows, [](const Row& row) { return row.left == 0 || row.price == 0; });
    }
    return paid < limit;
  }

  bool pay_common(State& state, Units& paid, Units limit) {
    for (Row& row : state.rows) {
      if (least_[row.id] == 0) continue;
      Units common = row.price;
      for_each_member(state, row.id, [&](std::uint32_t i, std::uint32_t coefficient) {
        common = std::min(common, state.arcs[i].rise / coefficient);
      });
      if (common == 0) continue;
      for_each_member(state, row.id, [&](std::uint32_t i, std::uint32_t coefficient) {
        state.arcs[i].rise -= common * coefficient;
      });
      row.price -= common;
      paid = std::min(limit, paid + common * row.left);
      if (paid == limit) break;
    }
    std::erase_if(state.rows, [](const Row& row) { return row.price == 0; });
    return paid < limit;
  }

  void spend(std::size_t work) {
    work_ += static_cast<double>(work);
    if (work_ > most_work_) throw ProofFault{"the search takes too long"};
  }

  // Whether an arc is left, while nothing was dropped since fill().
  bool is_left(const State& state, std::uint32_t arc) const {
    return where_[arc] < state.arcs.size() && state.arcs[where_[arc]].id == arc;
  }

  template <typename Visit>
  void for_each_member(const State& state, std::uint32_t row, Visit&& visit) {
    spend(arcs_of_[row].size());
    for (const Member member : arcs_of_[row]) {
      if (is_left(state, member.arc)) visit(where_[member.arc], member.coefficient);
    }
  }

  // The row with the fewest choices, dear ones counting less.
  Row tightest(const State& state, Units limit) const {
    const auto budget = static_cast<double>(limit);
    const auto width = [&](const Row& row) {
      const bool may_leave = row.left * row.price < limit;
      const double choices = static_cast<double>(filled_[row.id]) + (may_leave ? 1 : 0);
      const double leaving = std::min(budget, static_cast<double>(row.left * row.price));
      return kChoiceWidth * choices - (cost_[row.id] + leaving) / budget;
    };
    std::pair<double, std::size_t> best = {width(state.rows[0]), 0};
    for (std::size_t i = 1; i < state.rows.size(); ++i)
      best = std::min(best, {width(state.rows[i]), i});
    return state.rows[best.second];
  }

  bool uses(std::uint32_t arc, std::uint32_t row) const {
    for (const SearchEntry entry : task_.entries[arc]) {
      if (entry.row == row) return true;
    }
    return false;
  }

  std::vector<Arc> users(const State& state, std::uint32_t row) {
    std::vector<Arc> found;
    for_each_member(
        state, row, [&](std::uint32_t i, std::uint32_t) { found.push_back(state.arcs[i]); });
    std::sort(found.begin(), found.end(), [](const Arc& a, const Arc& b) {
      return a.rise != b.rise ? a.rise < b.rise : a.id < b.id;
    });
    return found;
  }

  void mark(std::uint32_t arc) {
    for (const SearchEntry entry : task_.entries[arc]) marked_[entry.row] += entry.coefficient;
  }

  bool meets_marks(std::uint32_t arc) const {
    for (const SearchEntry entry : task_.entries[arc]) {
      if (entry.row < task_.num_indices && marked_[entry.row] != 0) return true;
    }
    return false;
  }

  // What is left when arcs are used that are marked; clears the marks.
  State with(const State& state, const std::vector<std::uint32_t>& chosen) {
    State rest;
    for (const Arc& arc : state.arcs) {
      if (!meets_marks(arc.id)) rest.arcs.push_back(arc);
    }
    for (Row row : state.rows) {
      row.left -= std::min(row.left, marked_[row.id]);
      if (row.left > 0) rest.rows.push_back(row);
    }
    for (const std::uint32_t arc : chosen) {
      for (const SearchEntry entry : task_.entries[arc]) marked_[entry.row] = 0;
    }
    return rest;
  }

  State without(const State& state, std::uint32_t left) const {
    State rest;
    for (const Arc& arc : state.arcs) {
      if (!uses(arc.id, left)) rest.arcs.push_back(arc);
    }
    for (const Row& row : state.rows) {
      if (row.id != left) rest.rows.push_back(row);
    }
    return rest;
  }

  // Labels the rows of parts that no arc connects; returns how many there are.  Where that keeps
  // failing it is not always tried.
  std::size_t label_parts(const State& state) {
    if (pause_-- > 0) return 1;
    for (const Row& row : state.rows) label_[row.id] = kUnlabelled;
    for (const Arc& arc : state.arcs) {
      for (const SearchEntry entry : task_.entries[arc.id]) label_[entry.row] = kUnlabelled;
    }
    for (const Row& row : state.rows) marked_[row.id] = 1;
    std::uint32_t count = 0;
    for (const Row& row : state.rows) {
      if (label_[row.id] == kUnlabelled) flood(state, row.id, count++);
    }
    for (const Row& row : state.rows) marked_[row.id] = 0;
    pause_length_ = count > 1 ? 0 : std::min(2 * pause_length_ + 1, kLongestPause);
    pause_ = pause_length_;
    return count;
  }

  // The parts, smallest first; without arcs that fill no row.
  std::vector<State> divide(const State& state, std::size_t count) const {
    std::vector<State> parts(count);
    for (const Row& row : state.rows) parts[label_[row.id]].rows.push_back(row);
    for (const Arc& arc : state.arcs) {
      // Every arc uses an index, and all of its indices have the same label.
      const std::uint32_t part = label_[task_.entries[arc.id].front().row];
      if (part != kUnlabelled) parts[part].arcs.push_back(arc);
    }
    std::stable_sort(parts.begin(), parts.end(), [](const State& a, const State& b) {
      return a.arcs.size() < b.arcs.size();
    });
    return parts;
  }

  bool connects(std::uint32_t row) const { return row < task_.num_indices || marked_[row] != 0; }

  // Labels all rows that arcs connect with one.
  void flood(const State& state, std::uint32_t row, std::uint32_t part) {
    std::vector<std::uint32_t> ahead = {row};
    label_[row] = part;
    while (!ahead.empty()) {
      const std::uint32_t here = ahead.back();
      ahead.pop_back();
      spend(arcs_of_[here].size());
      for (const Member member : arcs_of_[here]) {
        if (!is_left(state, member.arc)) continue;
        for (const SearchEntry entry : task_.entries[member.arc]) {
          if (label_[entry.row] != kUnlabelled || !connects(entry.row)) continue;
          label_[entry.row] = part;
          ahead.push_back(entry.row);
        }
      }
    }
  }

  const SearchTask& task_;
  double& work_;
  const double most_work_;
  const double unit_;
  const Units limit_;
  std::vector<std::vector<Member>> arcs_of_;  // by row
  std::vector<Units> filled_;                 // by row: coefficients of the arcs left
  std::vector<double> cost_;                  // by row: sum of the costs of the arcs left
  std::vector<Units> least_;                  // by row: least cost of the arcs left
  std::vector<std::uint32_t> marked_;         // by row, 0 between uses
  std::vector<std::uint32_t> label_;          // by row: its part
  std::vector<std::uint32_t> where_;          // by arc: its position in the list counted last
  std::size_t held_ = 0;
  int pause_ = 0;
  int pause_length_ = 0;
};

}  // namespace

double least_rise(const SearchTask& task, double budget, double& work, double most_work) {
  return std::min(budget, ProofSearch(task, budget, work, most_work).run());
}

}  // namespace nda::core
