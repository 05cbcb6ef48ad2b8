#include <string>

#include "baselines/ranked_arcs.hpp"
#include "core/use_bounds.hpp"

// Semi-greedy track selection (Capponi & de Waard, section 2.1).  The paper sorts the track
// hypotheses by decreasing weight and builds one partition after the other, each from an initial
// hypothesis that none of the earlier ones contains; a pointer to the first such hypothesis only
// moves forwards (section 2.2). Differences: weights are minus the shifted costs, and hypotheses of
// weight <= 0 are left out, because greedy completion prefers false alarms of weight 0 to them and
// the guarantee does not hold with them; false alarms are implied by what stays uncovered and do
// not start partitions of their own.

namespace nda {
namespace {

using baselines::Cover;
using baselines::RankedArcs;
using baselines::Value;

class TrackSelection {
 public:
  explicit TrackSelection(const RankedArcs& ranked)
      : ranked_(ranked), cover_(ranked.num_slots()), used_(ranked.size(), false) {}

  // The next partition, or false when every arc was in one.  The first one always exists: without
  // arcs it is the empty partition.
  bool next(std::vector<std::size_t>& chosen) {
    while (initial_ < ranked_.size() && used_[initial_]) ++initial_;
    if (initial_ == ranked_.size() && started_) return false;
    started_ = true;
    cover_.clear();
    chosen.clear();
    if (initial_ < ranked_.size()) {
      cover_.add(ranked_.slots(initial_));
      chosen.push_back(initial_);
    }
    complete_greedily(ranked_, cover_, chosen);
    for (const std::size_t rank : chosen) used_[rank] = true;
    return true;
  }

 private:
  const RankedArcs& ranked_;
  Cover cover_;
  std::vector<bool> used_;
  std::size_t initial_ = 0;
  bool started_ = false;
};

void validate(const SgtsOptions& options) {
  if (options.max_partitions < 1) {
    throw InputError("max_partitions is " + std::to_string(options.max_partitions) +
                     ", at least 1 needed");
  }
}

}  // namespace

BaselineResult solve_sgts(const Problem& problem, const SgtsOptions& options) {
  validate(options);
  core::require_single_uses(problem, "semi-greedy track selection");
  const RankedArcs ranked(problem);
  TrackSelection selection(ranked);
  std::vector<std::size_t> best, chosen;
  selection.next(best);
  for (int i = 1; i < options.max_partitions && selection.next(chosen); ++i) {
    if (total_value(ranked, chosen) < total_value(ranked, best)) best = chosen;
  }
  return make_result(problem, ranked, best);
}

std::vector<BaselineResult> sgts_partitions(const Problem& problem, const SgtsOptions& options) {
  validate(options);
  core::require_single_uses(problem, "semi-greedy track selection");
  const RankedArcs ranked(problem);
  TrackSelection selection(ranked);
  std::vector<BaselineResult> partitions;
  std::vector<std::size_t> chosen;
  for (int i = 0; i < options.max_partitions && selection.next(chosen); ++i) {
    partitions.push_back(make_result(problem, ranked, chosen));
  }
  return partitions;
}

}  // namespace nda
