#include "bnb/slack_search.hpp"

#include <algorithm>
#include <deque>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "bnb/slack_descent.hpp"
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
// A search that is not over soon is shared out.  Several descents (bnb/slack_descent) go on side by
// side, in rounds: in each of them everyone does the same work, then all learn the least slack that
// anyone has found, and those with much left give of it, what is nearest to the root first, to
// those with nothing left.  Who does what is settled between rounds and by work alone, so threads
// change nothing but the time.
//
// Rounding: sums of terms below the budget err by far less than kTolerance of it, so a budget that
// much larger loses nothing.

namespace nda::bnb {
namespace {

constexpr double kTolerance = 0x1p-36;
constexpr std::size_t kMostAtOnce = 8;
constexpr double kLeastRound = 0.1;  // of the work of a round, where the limit is near
// Waiting between rounds, so that whoever is done within one finds something to go on with.
constexpr std::size_t kLeastWaiting = 24;

// One of several descents, what waits for it, and the best packing it came across.
struct Searcher {
  SlackDescent descent;
  std::deque<OpenSlack> waiting = {};
  double bound = kInfinity;  // what is found is to have less slack
  bool has_found = false;    // it has, a packing of this slack:
  double slack = kInfinity;
  std::vector<std::uint32_t> arcs = {};

  bool is_idle() const { return descent.is_done() && waiting.empty(); }

  void lower(double new_bound) {
    bound = std::min(bound, new_bound);
    if (!descent.is_done()) descent.lower(bound);
  }

  // Goes on by so much.  A limit that struck while others were at work stops it at once.
  void run(double more_work, std::int64_t more_nodes) {
    descent.moves().look_at_clock();
    const double max_work = descent.moves().work() + more_work;
    descent.moves().limit_nodes(descent.moves().nodes() + more_nodes);
    while (!is_idle()) {
      if (descent.is_done()) {
        descent.moves().look_at_clock();  // each begins with a copy of what is left
        if (descent.moves().stopped()) return;
        begin_next();
      }
      descent.run(max_work);
      if (!descent.is_done()) return;
      if (!(descent.slack() < bound)) continue;
      slack = descent.slack();
      bound = slack - descent.moves().step();
      has_found = true;
      arcs = descent.arcs();
    }
  }

  void begin_next() {
    OpenSlack next = std::move(waiting.front());
    waiting.pop_front();
    next.budget = std::min(next.budget, bound - next.before);
    descent.begin(next);
  }

  // With the best of what was seen.
  void stop() {
    waiting.clear();
    descent.moves().stop();
    run(0, 0);
  }
};

class SlackSearch {
 public:
  SlackSearch(const SlackProblem& problem,
              double budget,
              const SlackLimits& limits,
              const SlackRounds& rounds)
      : limits_(limits),
        rounds_(rounds),
        bound_(budget + (budget < kInfinity ? kTolerance * budget : 0)) {
    own_limits_.deadline = limits.deadline;
    own_limits_.step = limits.step;
    SlackMoves moves(problem, budget, own_limits_, FreeRows::kDrop);
    const auto whole = std::make_shared<OpenBranching>();
    moves.open(whole->node);
    searchers_.push_back({SlackDescent(std::move(moves))});
    searchers_.front().waiting.push_back({whole, 0, 0, bound_});
    searchers_.front().bound = bound_;
  }

  SlackResult run() {
    searchers_.front().run(std::min(rounds_.first_work, limits_.max_work), limits_.max_nodes);
    for (collect(); !is_over() && !is_stopped(); collect()) round();
    result_.complete = is_over();
    if (!result_.complete) {
      for (Searcher& searcher : searchers_) searcher.stop();
      collect();
    }
    return std::move(result_);
  }

 private:
  // Nothing is left to search, and nothing was left out.
  bool is_over() const {
    return std::all_of(searchers_.begin(), searchers_.end(), [](const Searcher& searcher) {
      return searcher.is_idle() && !searcher.descent.moves().stopped();
    });
  }

  bool is_stopped() const {
    return result_.work > limits_.max_work ||
           std::any_of(searchers_.begin(), searchers_.end(), [](const Searcher& searcher) {
             return searcher.descent.moves().stopped();
           });
  }

  void round() {
    while (searchers_.size() < kMostAtOnce)
      searchers_.push_back({SlackDescent(searchers_.front().descent.moves().fork())});
    for (Searcher& searcher : searchers_) searcher.lower(bound_);
    deal(share());
    const double work = std::clamp((limits_.max_work - result_.work) / kMostAtOnce,
                                   kLeastRound * rounds_.round_work,
                                   rounds_.round_work);
    const std::int64_t nodes = (limits_.max_nodes - result_.nodes) / std::int64_t{kMostAtOnce};
    limits_.for_all(searchers_.size(), [&](std::size_t s) { searchers_[s].run(work, nodes); });
  }

  // What waits, and if that is little, what those who are at work give away.
  std::vector<OpenSlack> share() {
    std::vector<OpenSlack> open;
    for (Searcher& searcher : searchers_) {
      std::move(searcher.waiting.begin(), searcher.waiting.end(), std::back_inserter(open));
      searcher.waiting.clear();
    }
    for (Searcher& searcher : searchers_) {
      if (open.size() >= kLeastWaiting) break;
      if (!searcher.descent.is_done()) searcher.descent.give_away(open);
    }
    return open;
  }

  // To whoever has the least.
  void deal(std::vector<OpenSlack> open) {
    const auto load = [](const Searcher& searcher) {
      return searcher.waiting.size() + (searcher.descent.is_done() ? 0 : 1);
    };
    for (OpenSlack& node : open) {
      const auto least = std::min_element(
          searchers_.begin(), searchers_.end(), [&](const Searcher& a, const Searcher& b) {
            return load(a) < load(b);
          });
      least->waiting.push_back(std::move(node));
    }
  }

  // What the searchers found and did.
  void collect() {
    result_.nodes = 0;
    result_.work = 0;
    result_.fixing = {};
    for (Searcher& searcher : searchers_) {
      result_.nodes += searcher.descent.moves().nodes();
      result_.work += searcher.descent.moves().work();
      result_.fixing += searcher.descent.moves().fixing();
      if (!std::exchange(searcher.has_found, false) || !(searcher.slack < bound_)) continue;
      result_.slack = searcher.slack;
      bound_ = searcher.bound;
      result_.arcs = searcher.arcs;
    }
  }

  const SlackLimits& limits_;
  const SlackRounds rounds_;
  SlackLimits own_limits_;  // of every descent
  std::deque<Searcher> searchers_;
  double bound_;  // on the slack that is looked for
  SlackResult result_;
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

SlackResult search_slack(const SlackProblem& problem,
                         double budget,
                         const SlackLimits& limits,
                         const SlackRounds& rounds) {
  return SlackSearch(problem, budget, limits, rounds).run();
}

}  // namespace nda::bnb
