#include "cutting/widening.hpp"

#include <algorithm>
#include <array>

#include "cutting/cut_loop.hpp"
#include "cutting/leaf_search.hpp"
#include "cutting/separation.hpp"

// A tree grows exponentially with the distance between its root's bound and its cutoff, so a cutoff
// that is too high costs more than all circles before it: what iterative deepening is to games
// (Korf 1985), this is to bounds.

namespace nda::cutting {
namespace {

using core::ArcId;

constexpr double kFirstReach = 0.25;              // of the gap
constexpr double kFirstReachWithoutCuts = 0.125;  // circles that end are all that raises the bound
constexpr double kLeastLeft = 0.05;               // of the gap, beyond a circle
// Cuts that close less than this part of the gap are not worth looking harder for, nor, where it is
// less than the other, looking for at every node: they close a tenth where many arcs fight for few
// indices, nine tenths where targets move side by side.
constexpr double kWorthwhile = 0.3;
constexpr double kWorthwhileAtNodes = 0.65;
constexpr double kWidenAtOnce = 4;  // where packings seem to be as good as they get
constexpr double kWidenFast = 2;
constexpr double kWidenSlowly = 1.5;
constexpr std::int64_t kFewNodes = 15;
constexpr double kPrimalShare = 1;  // at first, of the work for bounds
constexpr double kLeastPrimalShare = 0.125;
// Where less than this part of the first gap is left, the circles will find the best packing soon.
constexpr double kOpen = 8;
// Between two calls for better packings within a tree; at least half of all before, so that there
// are few.
constexpr double kLeastPauseWork = 1e7;
constexpr double kPauseShare = 0.5;
// A search within the slack often ends what has few indices, whatever the gap: the first one may
// take longer there, by this work over the number of indices.  In dense components cuts close
// little, and ten times that still takes less time than a tree.
constexpr double kFirstLeafWork = 4e8;
constexpr double kFirstDenseLeafWork = 4e9;
// A sixteenth of what a checker does for a proof, since the search may take that many times as
// long.
constexpr double kMostCoverWork = 1e9;
constexpr double kCoverShare = 0.05;  // of the work for bounds so far
// Rounds of cuts before each call for better packings, and after the last one.
constexpr std::array<int, 4> kRounds = {3, 8, 30, 200};

class Widening {
 public:
  Widening(const core::Component& component,
           std::span<const double> u,
           const WideningLimits& limits,
           const WideningObserver& observer)
      : component_(component),
        limits_(limits),
        observer_(observer),
        cutoff_(limits.cutoff),
        master_(component, core::all_arcs(component), u),
        proof_(limits.context.proof),
        proof_size_(proof_ == nullptr ? 0 : proof_->size()) {
    for (const Cut& cut : limits.cuts) master_.add(cut);
  }

  WideningResult run() {
    if (limits_.max_nodes > 0 && tighten()) {
      double reach = first_reach() * (cutoff_ - master_.lower());
      while (search(master_.lower() + reach)) {
        improve(0);
        if (cover(0)) break;
        reach *= widening();
      }
    }
    result_.complete = result_.lower >= cutoff_;
    result_.live_arcs = master_.live().size();
    if (proof_ != nullptr && (covered_ || !exhaustive_)) {
      proof_->cut_back(proof_size_);
      if (covered_)
        proof_->cliques({}, cutoff_);
      else
        proof_->bound(master_.u(), proof_cuts(master_.cuts()));
    }
    return result_;
  }

 private:
  // The cuts of the whole component.  Returns whether there is more to do.
  bool tighten() {
    ++result_.nodes;
    CutLoopOptions loop;
    loop.cutoff = cutoff_;
    loop.context = limits_.context;
    loop.work = &own_work_;
    LeafLimits leaf_limits;
    leaf_limits.max_nodes = limits_.max_nodes - result_.nodes;
    leaf_limits.context = limits_.context;
    LeafSearch leaf(component_, leaf_limits, 0, offer_);
    leaf.earn((limits_.context.is_dense ? kFirstDenseLeafWork : kFirstLeafWork) /
              static_cast<double>(component_.num_indices()));
    loop.leaf = &leaf;
    const auto round = [&](const Master& point) {
      if (result_.lower == -kInfinity) {
        observer_.relaxed(point);
        lower_without_cuts_ = limits_.cuts.empty() ? point.lower() : limits_.lower_without_cuts;
      }
      raise(point.lower());
      return offer_(point, nullptr);
    };
    CutLoopEnd end = CutLoopEnd::kRounds;
    for (std::size_t call = 0; call < kRounds.size() && may_go_on(end); ++call) {
      if (call > 0) {
        const double before = cutoff_;
        loop.cutoff = improve(0);
        // It would find the same once more, but where rows are so many that few of their sets were
        // looked at.
        const bool is_other = cutoff_ != before || (cuts_pay() && !loop.thorough) ||
                              component_.num_indices() > kFewRows;
        if (end == CutLoopEnd::kStalled && !is_other) break;
      }
      loop.max_rounds = kRounds[call];
      loop.thorough = cuts_pay();
      end = run_cut_loop(component_, master_, loop, round);
    }
    result_.nodes += leaf.nodes();
    result_.fixing += leaf.fixing();
    if (end == CutLoopEnd::kProven || end == CutLoopEnd::kSearched) raise(cutoff_);
    exhaustive_ = end == CutLoopEnd::kSearched;
    if (proof_ != nullptr) proof_size_ = proof_->size();
    return end != CutLoopEnd::kSearched && end != CutLoopEnd::kProven &&
           end != CutLoopEnd::kStopped;
  }

  static bool may_go_on(CutLoopEnd end) {
    return end == CutLoopEnd::kStalled || end == CutLoopEnd::kRounds;
  }

  // All packings cheaper than `target`.  Returns whether there is more to do.
  bool search(double target) {
    if (target > cutoff_ - kLeastLeft * (cutoff_ - master_.lower())) target = cutoff_;
    std::vector<ArcId> near;
    for (const ArcId a : master_.live()) {
      if (master_.lower() + master_.reduced_cost(a) < target) near.push_back(a);
    }
    const core::Component within = cutter_.cut(component_, near);
    Master circle(
        within, core::all_arcs(within), core::restrict_slots(component_, master_.u(), within));
    const std::vector<std::uint32_t> slots = core::slots_in_part(component_, within);
    for (const CutRow& row : master_.cuts()) circle.add(restrict_cut(row.cut, slots));
    if (proof_ != nullptr) {
      proof_->cut_back(proof_size_);
      proof_->fix(master_.u(), target, proof_cuts(master_.cuts()));
      proof_->enter(within);
    }
    BranchAndCutLimits limits;
    limits.max_nodes = limits_.max_nodes - result_.nodes;
    limits.root_patterns = kAllPatterns;
    limits.thorough = cuts_pay();
    if (closed_by_cuts() < kWorthwhileAtNodes) limits.node_patterns = 0;
    limits.margin = limits_.margin;
    limits.context = limits_.context;
    limits.pause = [&](std::int64_t nodes, double work) {
      if (is_improvement_due(work)) {
        improve(work);
        const std::int64_t before = result_.nodes;
        if (cover(nodes)) return -kInfinity;
        limits.max_nodes -= result_.nodes - before;
      }
      return std::min(cutoff_, target);
    };
    const PackingOffer offer = [&](const Master& point, const core::Packing* packing) {
      cutoff_ = observer_.offer(point, packing);
      return std::min(cutoff_, target);
    };
    const BranchAndCutResult found = search_tree(within, circle, target, limits, offer);
    if (proof_ != nullptr) proof_->enter(component_);
    result_.nodes += found.nodes;
    result_.fixing += found.fixing;
    last_tree_nodes_ = found.tree_nodes;
    own_work_ += found.work;
    exhaustive_ = found.exhaustive && target >= cutoff_;
    raise(std::min({found.lower, target, cutoff_}));
    return found.complete && result_.lower < cutoff_;
  }

  // All packings by cliques, which may take a part of what bounds took; returns whether that was
  // enough.
  bool cover(std::int64_t running) {
    LeafLimits limits;
    limits.max_nodes = limits_.max_nodes - result_.nodes - running;
    limits.context.deadline = limits_.context.deadline;
    LeafSearch leaf(component_, limits, 0, offer_);
    leaf.earn(std::min(kCoverShare * bound_work_, kMostCoverWork));
    covered_ = leaf.cover(master_, cutoff_);
    result_.nodes += leaf.nodes();
    own_work_ += leaf.work();
    if (covered_) raise(cutoff_);
    return covered_;
  }

  // Better packings get a share of the time that bounds got; a smaller one when none was found.
  // `running`: work of the circle that is being searched.
  double improve(double running) {
    const double now = work(running);
    const double new_work = now - bound_work_;
    bound_work_ = now;
    const double before = cutoff_;
    const double gap = before - master_.lower();
    if (first_gap_ == kInfinity) first_gap_ = gap;
    const double open = std::min(1.0, kOpen * gap / first_gap_);
    cutoff_ = observer_.improve(
        master_, {open * primal_share_ * new_work, bound_work_, primal_share_ > kLeastPrimalShare});
    own_work_ -= work(running) - now;  // pivots of dives
    primal_share_ =
        cutoff_ < before ? kPrimalShare : std::max(kLeastPrimalShare, primal_share_ / 2);
    return cutoff_;
  }

  bool is_improvement_due(double running) const {
    return work(running) - bound_work_ >= std::max(kLeastPauseWork, kPauseShare * bound_work_);
  }

  double first_reach() const { return cuts_pay() ? kFirstReach : kFirstReachWithoutCuts; }

  double widening() const {
    if (primal_share_ <= kPrimalShare / 4 && cuts_pay()) return kWidenAtOnce;
    if (primal_share_ < kPrimalShare || last_tree_nodes_ < kFewNodes) return kWidenFast;
    return kWidenSlowly;
  }

  bool cuts_pay() const { return closed_by_cuts() >= kWorthwhile; }

  // A share of the gap.
  double closed_by_cuts() const {
    return (master_.lower() - lower_without_cuts_) / (cutoff_ - lower_without_cuts_);
  }

  // For bounds.
  double work(double running) const {
    return work_of_pivots(master_.simplex_iterations(), component_.num_slots()) + own_work_ +
           running;
  }

  void raise(double lower) {
    if (lower <= result_.lower) return;
    result_.lower = lower;
    observer_.raise(lower);
  }

  const core::Component& component_;
  const WideningLimits& limits_;
  const WideningObserver& observer_;
  double cutoff_;
  const PackingOffer offer_ = [this](const Master& master, const core::Packing* packing) {
    return cutoff_ = observer_.offer(master, packing);
  };
  Master master_;
  core::Cutter cutter_;
  bnb::ProofLog* const proof_;  // may be null
  std::size_t proof_size_;      // before the circles
  bool exhaustive_ = false;     // the last circle holds all, and its tree was searched to the end
  bool covered_ = false;        // cover() was enough
  double primal_share_ = kPrimalShare;
  double lower_without_cuts_ = kInfinity;
  double first_gap_ = kInfinity;  // at the first call for better packings
  std::int64_t last_tree_nodes_ = 0;
  double own_work_ = 0;    // of searches and separation, and of all circles
  double bound_work_ = 0;  // work() at the last call for better packings
  WideningResult result_;
};

}  // namespace

WideningResult search_widening(const core::Component& component,
                               std::span<const double> u,
                               const WideningLimits& limits,
                               const WideningObserver& observer) {
  return Widening(component, u, limits, observer).run();
}

}  // namespace nda::cutting
