#include "cutting/cut_loop.hpp"

#include <algorithm>

#include "core/pause.hpp"
#include "core/random.hpp"
#include "cutting/leaf_search.hpp"
#include "cutting/separation.hpp"

// The order of the patterns and the limits are measured: docs/cuts.md.

namespace nda::cutting {
namespace {

constexpr SeparationEffort kQuick = {0.02, 1, 3};
constexpr SeparationEffort kThorough = {0.005, 4, 6};
constexpr std::size_t kLeastCuts = 400;
constexpr int kMostIdle = 3;
constexpr int kLongestPause = 7;
constexpr int kPatience = 2;

// Separation by all patterns.  One that finds nothing pauses, each time for longer.  They share
// nothing but the point, so they may go on at once.
class Separation {
 public:
  Separation(const core::Deadline& deadline, const core::ForAll& for_all)
      : deadline_(deadline),
        for_all_(for_all),
        pauses_(patterns().size(), core::Pause(kLongestPause)) {}

  // All violated cuts that are found by the first `count` patterns and by three rows.
  std::vector<ViolatedCut> operator()(const Separator& separator,
                                      std::size_t count,
                                      const SeparationEffort& effort) {
    std::vector<Search> searches;
    for (std::size_t p = 0; p < count; ++p) {
      if (!pauses_[p].skip()) searches.push_back({p, random_(), separator, {}});
    }
    std::vector<ViolatedCut> found;
    for_all_(searches.size() + 1, [&](std::size_t n) {
      if (n == searches.size()) {
        found = separator.three_rows(effort.least_violation, deadline_);
      } else {
        Search& search = searches[n];
        search.cuts =
            search.separator.search(patterns()[search.pattern], effort, search.seed, deadline_);
      }
    });
    for (Search& search : searches) {
      work_ += search.separator.work() - separator.work();
      pauses_[search.pattern].note(!search.cuts.empty());
      keep_most_violated(search.cuts, kLeastCuts);
      found.insert(found.end(), search.cuts.begin(), search.cuts.end());
    }
    return found;
  }

  // Of all searches (Separator::work).
  double work() const { return work_; }

  // Ends all pauses.
  void wake() { pauses_.assign(pauses_.size(), core::Pause(kLongestPause)); }

 private:
  struct Search {
    std::size_t pattern;
    std::uint64_t seed;
    Separator separator;
    std::vector<ViolatedCut> cuts;
  };

  const core::Deadline& deadline_;
  const core::ForAll& for_all_;
  core::Random random_{1};
  std::vector<core::Pause> pauses_;
  double work_ = 0;
};

bool search(LeafSearch& leaf, const Master& master, double& cutoff, double* work) {
  const double before = leaf.work();
  const bool ended = leaf(master, cutoff);
  if (work != nullptr) *work += leaf.work() - before;
  return ended;
}

}  // namespace

CutLoopEnd run_cut_loop(const core::Component& component,
                        Master& master,
                        const CutLoopOptions& options,
                        const CutRoundObserver& observer) {
  double cutoff = options.cutoff;
  double last_lower = -kInfinity;
  int idle_rounds = 0;
  bool thorough = false;
  Separation separate(options.context.deadline, options.context.for_all);
  const std::size_t last = std::min(options.most_patterns, patterns().size());
  std::size_t stage = std::min(options.first_patterns, last);
  const auto look_harder = [&] {
    if (thorough || !options.thorough) return false;
    separate.wake();
    idle_rounds = 0;
    return thorough = true;
  };
  for (int round = 0; round < std::max(1, options.max_rounds); ++round) {
    const lp::Outcome outcome = master.solve(cutoff, options.context.deadline);
    if (outcome == lp::Outcome::kCutoff) return CutLoopEnd::kProven;
    if (outcome != lp::Outcome::kOptimal) return CutLoopEnd::kStopped;
    cutoff = observer(master);
    if (master.lower() >= cutoff) return CutLoopEnd::kProven;
    const double gap = cutoff - master.lower();
    const double gain = master.lower() - last_lower;
    last_lower = master.lower();
    if (options.fix && master.fix(cutoff) && options.context.proof != nullptr)
      options.context.proof->fix(master.u(), cutoff, proof_cuts(master.cuts()));
    if (options.leaf != nullptr && search(*options.leaf, master, cutoff, options.work))
      return CutLoopEnd::kSearched;
    master.drop_idle(kMostIdle);
    const Separator separator(component, master.arcs(), master.values());
    if (separator.integral()) return CutLoopEnd::kIntegral;
    if (options.max_rounds == 0) return CutLoopEnd::kStalled;
    if (gain < options.worthwhile * gap) {
      const bool stalled = stage == last && ++idle_rounds > (thorough ? 0 : kPatience);
      if (stalled && !look_harder()) return CutLoopEnd::kStalled;
      stage = std::min(last, stage == 0 ? 1 : stage + 3);
    } else {
      idle_rounds = 0;
    }
    const double before = separate.work();
    std::vector<ViolatedCut> cuts = separate(separator, stage, thorough ? kThorough : kQuick);
    if (cuts.empty() && stage == last) {
      if (!look_harder()) return CutLoopEnd::kStalled;
      cuts = separate(separator, stage, kThorough);
    }
    if (options.leaf != nullptr) options.leaf->earn(separate.work() - before);
    if (options.work != nullptr) *options.work += separate.work() - before;
    keep_most_violated(cuts, std::max(kLeastCuts, component.num_indices() / 5));
    for (const ViolatedCut& violated : cuts) master.add(violated.cut);
  }
  return CutLoopEnd::kRounds;
}

}  // namespace nda::cutting
