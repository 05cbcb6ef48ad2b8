#include "cutting/branch_and_cut.hpp"

#include <algorithm>
#include <cmath>

// Branching on a pair of rows keeps both children packing problems and halves the fractional point
// on both sides, where fixing one arc to 0 would change next to nothing.  Which pair: a few with a
// weight near a half are tried, by some dual simplex steps each, and the product of what their two
// children gain decides (strong branching, Applegate et al. 1995).

namespace nda::cutting {
namespace {

using core::ArcId;

constexpr double kIntegral = 1e-6;
constexpr std::size_t kCandidates = 8;
constexpr int kTrialIterations = 60;
constexpr double kWorthwhile = 0.03;

}  // namespace

BranchAndCut::BranchAndCut(const core::Component& component,
                           Master& master,
                           double cutoff,
                           const BranchAndCutLimits& limits,
                           PackingOffer offer)
    : component_(component),
      master_(master),
      cutoff_(cutoff),
      limits_(limits),
      offer_(std::move(offer)) {}

BranchAndCutResult BranchAndCut::run() {
  BranchAndCutResult result;
  result.lower = explore(0, -kInfinity);
  result.complete = result.lower >= cutoff_;
  result.exhaustive = exhaustive_;
  result.nodes = num_nodes();
  result.tree_nodes = tree_nodes_;
  result.work = work();
  return result;
}

// Lower bound of the subtree: at least the cutoff when nothing cheaper is left in it.
double BranchAndCut::explore(int depth, double inherited) {
  // No checker would follow a deeper tree.
  if (stopped() || depth > kMostProofBranchings) return leave(inherited);
  ++tree_nodes_;
  const CutLoopEnd end = tighten(depth);
  const double lower =
      end == CutLoopEnd::kStopped ? inherited : std::max(inherited, master_.lower());
  if (end == CutLoopEnd::kSearched) return std::max(lower, cutoff_);
  if (lower >= cutoff_ || end == CutLoopEnd::kStopped || stopped()) return close(lower);
  if (integral()) {
    const core::Packing found = packing();
    cutoff_ = offer_(master_, &found);
    return close(lower);
  }
  if (limits_.pause) cutoff_ = limits_.pause(num_nodes(), work());
  if (lower >= cutoff_) return close(lower);
  const Choice choice = choose();
  const bool together_first = choice.together <= choice.apart;
  if (limits_.proof != nullptr)
    limits_.proof->branch(choice.pair.first, choice.pair.second, together_first);
  double least = kInfinity;
  for (const bool together : {together_first, !together_first}) {
    if (stopped()) return leave(lower);
    least = std::min(least,
                     together ? explore_together(choice.pair, depth + 1, lower)
                              : explore_apart(choice.pair, depth + 1, lower));
  }
  return least;
}

// The cuts of a node.
CutLoopEnd BranchAndCut::tighten(int depth) {
  CutLoopOptions loop;
  loop.cutoff = cutoff_;
  loop.max_rounds = depth == 0 ? limits_.root_rounds : limits_.node_rounds;
  loop.first_patterns = depth == 0 ? limits_.root_patterns : limits_.node_patterns;
  if (depth > 0) loop.most_patterns = limits_.node_patterns;
  loop.fix = depth == 0;
  loop.thorough = depth == 0 && limits_.thorough;
  loop.proof = limits_.proof;
  loop.worthwhile = kWorthwhile;
  loop.deadline = limits_.deadline;
  loop.work = &search_work_;
  const PackingOffer offer = [&](const Master& master, const core::Packing* packing) {
    return cutoff_ = offer_(master, packing);
  };
  const std::int64_t pivots = depth == 0 ? 0 : master_.simplex_iterations();
  LeafSearch leaf(component_, leaf_limits(), pivots, offer, &clique_pause_);
  if (depth == 0 || !leaf_pause_.skip()) loop.leaf = &leaf;
  const auto round = [&](const Master& master) {
    if (depth == 0) offer(master, nullptr);
    return cutoff_;
  };
  const CutLoopEnd end = run_cut_loop(component_, master_, loop, round);
  search_nodes_ += leaf.nodes();
  if (leaf.nodes() > 0) leaf_pause_.note(end == CutLoopEnd::kSearched);
  return end;
}

LeafLimits BranchAndCut::leaf_limits() const {
  LeafLimits limits;
  limits.max_work = limits_.leaf_work;
  limits.max_nodes = limits_.max_nodes - num_nodes();
  limits.deadline = limits_.deadline;
  limits.proof = limits_.proof;
  return limits;
}

double BranchAndCut::work() const {
  return work_of_pivots(master_.simplex_iterations(), component_.num_slots()) + search_work_;
}

// Nodes that a limit leaves unexplored.
double BranchAndCut::leave(double lower) {
  exhaustive_ = false;
  return lower;
}

// A leaf.
double BranchAndCut::close(double lower) {
  if (limits_.proof != nullptr) limits_.proof->bound(master_);
  return lower;
}

bool BranchAndCut::integral() const {
  for (const double x : master_.values()) {
    if (x > kIntegral && x < 1 - kIntegral) return false;
  }
  return true;
}

core::Packing BranchAndCut::packing() const {
  std::vector<ArcId> arcs;
  for (std::size_t k = 0; k < master_.arcs().size(); ++k) {
    if (master_.values()[k] >= 0.5) arcs.push_back(master_.arcs()[k]);
  }
  return core::make_packing(component_, std::move(arcs));
}

std::vector<BranchAndCut::Pair> BranchAndCut::fractional_pairs() const {
  std::vector<Pair> pairs;
  std::vector<std::uint32_t> slots;
  for (std::size_t k = 0; k < master_.arcs().size(); ++k) {
    const double x = master_.values()[k];
    if (x <= kIntegral || x >= 1 - kIntegral) continue;
    slots.clear();
    core::for_each_slot(component_, master_.arcs()[k], [&](std::uint32_t slot) {
      for (const std::uint32_t other : slots) pairs.push_back({other, slot, x});
      slots.push_back(slot);
    });
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
  std::vector<Pair> merged;
  for (const Pair& pair : pairs) {
    if (!merged.empty() && merged.back().first == pair.first && merged.back().second == pair.second)
      merged.back().weight += pair.weight;
    else
      merged.push_back(pair);
  }
  std::erase_if(merged, [](const Pair& pair) { return pair.weight >= 1 - kIntegral; });
  return merged;
}

BranchAndCut::Choice BranchAndCut::choose() {
  std::vector<Pair> pairs = fractional_pairs();
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::abs(a.weight - 0.5) < std::abs(b.weight - 0.5);
  });
  if (pairs.size() > kCandidates) pairs.resize(kCandidates);
  const std::vector<unsigned char> basis = master_.basis();
  const double lower = master_.lower();
  Choice best{};
  double best_score = -1;
  for (const Pair& pair : pairs) {
    Choice choice{pair, 0, 0};
    const std::vector<ArcId> one = arcs_of_one(pair);
    master_.forbid(one);
    master_.force(pair.first);
    choice.together = master_.trial(kTrialIterations, limits_.deadline);
    master_.release(pair.first);
    master_.allow(one);
    master_.set_basis(basis);
    const std::vector<ArcId> both = arcs_of_both(pair);
    master_.forbid(both);
    choice.apart = master_.trial(kTrialIterations, limits_.deadline);
    master_.allow(both);
    master_.set_basis(basis);
    const auto gain = [&](double bound) {
      return std::max(1e-6, std::min(bound, cutoff_) - lower);
    };
    const double score = gain(choice.together) * gain(choice.apart);
    if (score > best_score) {
      best_score = score;
      best = choice;
    }
  }
  return best;
}

bool BranchAndCut::uses(ArcId a, std::uint32_t slot) const {
  bool found = false;
  core::for_each_slot(component_, a, [&](std::uint32_t s) { found = found || s == slot; });
  return found;
}

std::vector<ArcId> BranchAndCut::arcs_of_one(const Pair& pair) const {
  std::vector<ArcId> arcs;
  for (const ArcId a : master_.index()[pair.first]) {
    if (!uses(a, pair.second)) arcs.push_back(a);
  }
  for (const ArcId a : master_.index()[pair.second]) {
    if (!uses(a, pair.first)) arcs.push_back(a);
  }
  return arcs;
}

std::vector<ArcId> BranchAndCut::arcs_of_both(const Pair& pair) const {
  std::vector<ArcId> arcs;
  for (const ArcId a : master_.index()[pair.first]) {
    if (uses(a, pair.second)) arcs.push_back(a);
  }
  return arcs;
}

double BranchAndCut::explore_together(const Pair& pair, int depth, double inherited) {
  const std::vector<ArcId> one = arcs_of_one(pair);
  master_.forbid(one);
  master_.force(pair.first);
  const double lower = explore(depth, inherited);
  master_.release(pair.first);
  master_.allow(one);
  return lower;
}

double BranchAndCut::explore_apart(const Pair& pair, int depth, double inherited) {
  const std::vector<ArcId> both = arcs_of_both(pair);
  master_.forbid(both);
  const double lower = explore(depth, inherited);
  master_.allow(both);
  return lower;
}

}  // namespace nda::cutting
