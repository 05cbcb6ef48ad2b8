#include "cutting/branch_and_cut.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

// The tree: bound a node by the linear relaxation and cuts, end it by a search within the slack
// where that is short, else branch on a pair of rows, and dive into the child of smaller bound.

namespace nda::cutting {
namespace {

using core::ArcId;

constexpr double kIntegral = 1e-6;
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
      offer_(std::move(offer)),
      branching_(component, master, limits.context.deadline),
      first_pivots_(master.simplex_iterations()) {}

BranchAndCutResult BranchAndCut::run(const OpenNode& node,
                                     std::size_t steps,
                                     double handover_work) {
  handover_work_ = handover_work;
  for (std::size_t s = steps; s < node.path.size(); ++s) branching_.descend(node.path[s]);
  path_ = node.path;
  pauses_ = node.pauses;
  BranchAndCutResult result;
  result.lower = explore(static_cast<int>(path_.size()), node.lower);
  result.complete = result.lower >= cutoff_ && open_.empty();
  result.open = std::move(open_);
  result.exhaustive = exhaustive_;
  result.nodes = num_nodes();
  result.tree_nodes = tree_nodes_;
  result.work = work();
  result.fixing = fixing_;
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
  if (end == CutLoopEnd::kSearched) return finish(depth, std::max(lower, cutoff_));
  if (lower >= cutoff_ || end == CutLoopEnd::kStopped || stopped()) return close(depth, lower);
  if (integral()) {
    const core::Packing found = packing();
    cutoff_ = offer_(master_, &found);
    if (limits_.ranks == nullptr) return close(depth, lower);
  }
  if (limits_.pause) cutoff_ = limits_.pause(num_nodes(), work());
  if (lower >= cutoff_) return close(depth, lower);
  std::vector<PairBranching::Pair> pairs = branching_.fractional_pairs();
  if (pairs.empty() && limits_.ranks != nullptr) pairs = branching_.open_pairs();
  if (pairs.empty()) return close_single(depth, lower);
  const PairBranching::Choice choice = branching_.choose(std::move(pairs), cutoff_);
  const bool together_first = choice.together <= choice.apart;
  if (limits_.context.proof != nullptr)
    limits_.context.proof->branch(choice.pair.first, choice.pair.second, together_first);
  double least = kInfinity;
  for (const bool together : {together_first, !together_first}) {
    if (stopped()) return leave(lower);
    path_.push_back({choice.pair, together});
    const auto explore_child = [&] { least = std::min(least, explore(depth + 1, lower)); };
    if (work() >= handover_work_)
      open_.push_back({path_,
                       lower,
                       pauses_,
                       limits_.context.proof != nullptr ? limits_.context.proof->size() : 0});
    else if (together)
      branching_.together(choice.pair, explore_child);
    else
      branching_.apart(choice.pair, explore_child);
    path_.pop_back();
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
  loop.worthwhile = kWorthwhile;
  loop.context = limits_.context;
  loop.work = &search_work_;
  const PackingOffer offer = [&](const Master& master, const core::Packing* packing) {
    return cutoff_ = offer_(master, packing);
  };
  const std::int64_t pivots = depth == 0 ? 0 : master_.simplex_iterations();
  LeafSearch leaf(component_, leaf_limits(), pivots, offer, &pauses_.cliques);
  if (depth == 0 || !pauses_.slack.skip()) loop.leaf = &leaf;
  const auto round = [&](const Master& master) {
    if (depth == 0) offer(master, nullptr);
    return cutoff_;
  };
  const std::size_t arcs = master_.live().size();
  const CutLoopEnd end = run_cut_loop(component_, master_, loop, round);
  fixing_.dropped += arcs - master_.live().size();
  fixing_ += leaf.fixing();
  search_nodes_ += leaf.nodes();
  if (leaf.nodes() > 0) pauses_.slack.note(end == CutLoopEnd::kSearched);
  return end;
}

LeafLimits BranchAndCut::leaf_limits() const {
  LeafLimits limits;
  limits.max_work = limits_.leaf_work;
  limits.max_nodes = limits_.max_nodes - num_nodes();
  limits.context = limits_.context;
  limits.ranks = limits_.ranks;
  return limits;
}

double BranchAndCut::work() const {
  return work_of_pivots(master_.simplex_iterations() - first_pivots_, component_.num_slots()) +
         search_work_;
}

// Nodes that a limit leaves unexplored.
double BranchAndCut::leave(double lower) {
  exhaustive_ = false;
  return lower;
}

// A leaf.
double BranchAndCut::close(int depth, double lower) {
  if (limits_.context.proof != nullptr)
    limits_.context.proof->bound(master_.u(), proof_cuts(master_.cuts()));
  return finish(depth, lower);
}

// Where more than the best counts: all arcs that are left go together.
double BranchAndCut::close_single(int depth, double lower) {
  if (limits_.ranks == nullptr) return close(depth, lower);
  std::vector<ArcId> arcs;
  std::ranges::copy_if(
      master_.live(), std::back_inserter(arcs), [&](ArcId a) { return !master_.forbidden(a); });
  const core::Packing only = core::make_packing(component_, std::move(arcs));
  cutoff_ = offer_(master_, &only);
  return finish(depth, std::max(lower, cutoff_));
}

double BranchAndCut::finish(int depth, double lower) {
  progress_ += std::ldexp(1.0, -depth);
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

}  // namespace nda::cutting
