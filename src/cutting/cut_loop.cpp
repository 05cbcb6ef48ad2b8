#include "cutting/cut_loop.hpp"

#include <algorithm>

#include "core/random.hpp"
#include "cutting/separation.hpp"

// The order of the patterns and the limits are measured: docs/cuts.md.

namespace nda::cutting {
namespace {

constexpr double kLeastViolation = 0.02;
constexpr std::size_t kLeastCuts = 400;
constexpr int kMostIdle = 3;
// A round that closes less than this share of the gap calls for harder patterns, or ends the loop.
constexpr double kWorthwhile = 0.002;
constexpr int kPatience = 2;

// The most violated cuts, few of them over the same row.
void keep_best(std::vector<ViolatedCut>& cuts, std::size_t most) {
  const auto order = [](const ViolatedCut& a, const ViolatedCut& b) {
    if (a.violation != b.violation) return a.violation > b.violation;
    return a.cut.slots < b.cut.slots;
  };
  std::sort(cuts.begin(), cuts.end(), order);
  if (cuts.size() > most) cuts.resize(most);
}

std::vector<ViolatedCut> separate(Separator& separator,
                                  std::size_t stage,
                                  core::Random& random,
                                  const core::Deadline& deadline) {
  std::vector<ViolatedCut> found = separator.three_rows(kLeastViolation);
  for (std::size_t p = 0; p < stage; ++p) {
    std::vector<ViolatedCut> more =
        separator.search(patterns()[p], kLeastViolation, random, deadline);
    keep_best(more, kLeastCuts);
    found.insert(found.end(), more.begin(), more.end());
  }
  return found;
}

}  // namespace

CutLoopEnd run_cut_loop(const core::Component& component,
                        Master& master,
                        const CutLoopOptions& options,
                        const CutLoopObserver& observer) {
  double cutoff = options.cutoff;
  double last_lower = -kInfinity;
  int idle_rounds = 0;
  core::Random random(1);
  const std::size_t last = std::min(options.most_patterns, patterns().size());
  std::size_t stage = std::min(options.first_patterns, last);
  for (int round = 0; round < options.max_rounds; ++round) {
    const lp::Outcome outcome = master.solve(cutoff, options.deadline);
    if (outcome == lp::Outcome::kCutoff) return CutLoopEnd::kProven;
    if (outcome != lp::Outcome::kOptimal) return CutLoopEnd::kStopped;
    cutoff = observer.round(master);
    if (master.lower() >= cutoff) return CutLoopEnd::kProven;
    const double gap = cutoff - master.lower();
    const double gain = master.lower() - last_lower;
    last_lower = master.lower();
    if (options.fix) master.fix(cutoff);
    master.drop_idle(kMostIdle);
    Separator separator(component, master.arcs(), master.values());
    if (separator.integral()) return CutLoopEnd::kIntegral;
    if (gain < kWorthwhile * gap) {
      if (stage == last && ++idle_rounds > kPatience) return CutLoopEnd::kStalled;
      stage = std::min(last, stage == 0 ? 1 : stage + 3);
    } else {
      idle_rounds = 0;
    }
    std::vector<ViolatedCut> cuts = separate(separator, stage, random, options.deadline);
    keep_best(cuts, std::max(kLeastCuts, component.num_indices() / 5));
    if (cuts.empty() && stage == last) return CutLoopEnd::kStalled;
    for (const ViolatedCut& violated : cuts) master.add(violated.cut);
  }
  return CutLoopEnd::kStalled;
}

}  // namespace nda::cutting
