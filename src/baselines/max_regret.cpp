#include <algorithm>
#include <queue>

#include "baselines/ranked_arcs.hpp"
#include "core/use_bounds.hpp"

// Max-regret after Balas & Saltzman (1991).  They take the regrets of the rows of a dense cube;
// here every uncovered index of every dimension has one, and leaving it alone is always a choice.
// The arcs of a slot are listed best first, so its two best live ones are found by two pointers
// that only move forwards.  A regret changes only when one of those two arcs dies; then a new entry
// goes into the queue and the old one, recognised by its stamp, is skipped when it comes up.

namespace nda {
namespace {

using baselines::RankedArcs;
using baselines::Value;

struct Regret {
  Value loss;  // of the best choice against the second: more negative is a larger regret
  std::uint32_t slot;
  std::uint32_t stamp;

  // std::priority_queue serves the greatest: the largest regret, ties to the lowest slot.
  friend bool operator<(const Regret& a, const Regret& b) {
    if (b.loss < a.loss) return true;
    return a.loss < b.loss ? false : a.slot > b.slot;
  }
};

class MaxRegret {
 public:
  explicit MaxRegret(const RankedArcs& ranked)
      : ranked_(ranked),
        start_(ranked.num_slots() + 1, 0),
        best_(ranked.num_slots()),
        second_(ranked.num_slots()),
        stamp_(ranked.num_slots(), 0),
        dead_(ranked.size(), false) {
    list_ranks_by_slot();
    for (std::uint32_t slot = 0; slot < ranked.num_slots(); ++slot) {
      best_[slot] = start_[slot];
      second_[slot] = start_[slot] + 1;
      refresh(slot);
    }
  }

  std::vector<std::size_t> run() {
    std::vector<std::size_t> chosen;
    while (!queue_.empty()) {
      const Regret top = queue_.top();
      queue_.pop();
      if (top.stamp != stamp_[top.slot]) continue;
      chosen.push_back(ranks_[best_[top.slot]]);
      choose(chosen.back());
    }
    return chosen;
  }

 private:
  void list_ranks_by_slot() {
    for (std::size_t rank = 0; rank < ranked_.size(); ++rank) {
      for (const std::uint32_t slot : ranked_.slots(rank)) ++start_[slot + 1];
    }
    for (std::size_t slot = 0; slot < ranked_.num_slots(); ++slot) start_[slot + 1] += start_[slot];
    ranks_.resize(start_.back());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t rank = 0; rank < ranked_.size(); ++rank) {
      for (const std::uint32_t slot : ranked_.slots(rank)) ranks_[next[slot]++] = rank;
    }
  }

  std::size_t next_live(std::uint32_t slot, std::size_t position) const {
    while (position < start_[slot + 1] && dead_[ranks_[position]]) ++position;
    return position;
  }

  Value value_at(std::uint32_t slot, std::size_t position) const {
    return position < start_[slot + 1] ? ranked_.value(ranks_[position]) : Value{};
  }

  // Finds the two best live arcs of the slot anew and queues its regret.
  void refresh(std::uint32_t slot) {
    ++stamp_[slot];
    best_[slot] = next_live(slot, best_[slot]);
    second_[slot] = next_live(slot, std::max(best_[slot] + 1, second_[slot]));
    if (best_[slot] >= start_[slot + 1]) return;
    const Value best = value_at(slot, best_[slot]);
    const Value second = value_at(slot, second_[slot]);
    queue_.push({{best.forced - second.forced, best.shifted - second.shifted}, slot, stamp_[slot]});
  }

  bool is_among_two_best(std::uint32_t slot, std::size_t rank) const {
    const auto holds = [&](std::size_t p) { return p < start_[slot + 1] && ranks_[p] == rank; };
    return holds(best_[slot]) || holds(second_[slot]);
  }

  // Covers the slots of the arc; every arc that touches them dies.
  void choose(std::size_t chosen) {
    std::vector<std::uint32_t> touched;
    for (const std::uint32_t slot : ranked_.slots(chosen)) {
      ++stamp_[slot];
      for (std::size_t p = start_[slot]; p < start_[slot + 1]; ++p) {
        const std::size_t rank = ranks_[p];
        if (dead_[rank]) continue;
        dead_[rank] = true;
        for (const std::uint32_t other : ranked_.slots(rank)) {
          if (is_among_two_best(other, rank)) touched.push_back(other);
        }
      }
    }
    for (const std::uint32_t slot : touched) refresh(slot);
  }

  const RankedArcs& ranked_;
  std::vector<std::size_t> start_;  // [slot]: its part of ranks_
  std::vector<std::size_t> ranks_;
  std::vector<std::size_t> best_;     // [slot]: position in ranks_
  std::vector<std::size_t> second_;   // [slot]
  std::vector<std::uint32_t> stamp_;  // [slot]: of its valid queue entry
  std::vector<bool> dead_;            // [rank]
  std::priority_queue<Regret> queue_;
};

}  // namespace

BaselineResult solve_max_regret(const Problem& problem) {
  core::require_single_uses(problem, "max-regret");
  const RankedArcs ranked(problem);
  return make_result(problem, ranked, MaxRegret(ranked).run());
}

}  // namespace nda
