#include "sliding_windows.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "generate/hypotheses.hpp"
#include "generate/scenario.hpp"
#include "nda/solve.hpp"

// Hypotheses of an established track are those of generate::Hypotheses over the scans before the
// window, of which nothing is left but what tracks own, and the window; those that mix tracks, or
// leave out what a track has, are dropped.

namespace nda::bench {
namespace {

using generate::Scan;

// What a track owns of every scan so far: an index, or 0.
using Track = std::vector<Index>;

class Tracker {
 public:
  Tracker(const TrackingOptions& options, int moves, int history)
      : options_(options), history_(history) {
    TrackingOptions whole = options;
    whole.scans = options.scans + moves;
    scans_ = generate::draw_scans(whole);
  }

  Problem window(int first) {
    const int before = std::min(history_, first);
    const std::vector<Scan> seen = visible(first, before);
    TrackingOptions options = options_;
    options.scans = static_cast<int>(seen.size());
    std::vector<Index> sizes = {static_cast<Index>(tracks_.size())};
    for (std::size_t s = static_cast<std::size_t>(before); s < seen.size(); ++s)
      sizes.push_back(static_cast<Index>(seen[s].size()));
    ProblemBuilder builder(sizes);
    generate::Hypotheses hypotheses(options, seen);
    for (int s = options.scans - 1; s >= 0; --s) {
      for (std::uint32_t j = 0; j < seen[static_cast<std::size_t>(s)].size(); ++j) {
        hypotheses.enumerate(s, j);
        for (std::size_t h = 0; h < hypotheses.size(); ++h)
          add(builder, hypotheses.tuple(h), before, generate::from_micro(hypotheses.cost(h)));
      }
    }
    return std::move(builder).build();
  }

  // Fixes what the first scan of the window belongs to.
  void follow(int first, const std::vector<std::vector<Index>>& arcs) {
    for (Track& track : tracks_) track.push_back(0);
    for (const std::vector<Index>& arc : arcs) {
      if (arc[1] == 0) continue;
      if (arc[0] > 0) {
        tracks_[arc[0] - 1].back() = arc[1];
      } else {
        tracks_.emplace_back(static_cast<std::size_t>(first), 0).push_back(arc[1]);
      }
    }
  }

 private:
  // The scans from first - before on; those before the window without what no track owns.
  // owners_ tells whose the others are.
  std::vector<Scan> visible(int first, int before) {
    std::vector<Scan> seen;
    owners_.assign(static_cast<std::size_t>(before), {});
    for (std::size_t b = 0; b < owners_.size(); ++b) {
      const std::size_t s = static_cast<std::size_t>(first - before) + b;
      std::vector<std::size_t> owner(scans_[s].size() + 1, tracks_.size());
      for (std::size_t t = 0; t < tracks_.size(); ++t) owner[tracks_[t][s]] = t;
      Scan& scan = seen.emplace_back();
      for (std::size_t j = 0; j < scans_[s].size(); ++j) {
        if (owner[j + 1] == tracks_.size()) continue;
        scan.push_back(scans_[s][j]);
        owners_[b].push_back(owner[j + 1]);
      }
    }
    seen.insert(seen.end(), scans_.begin() + first, scans_.begin() + first + options_.scans);
    return seen;
  }

  // 1 + the track that has these detections before the window and no others there; 0 where there
  // are none.
  Index owner_of(std::span<const Index> before) const {
    Index owner = 0;
    for (std::size_t b = 0; b < before.size(); ++b) {
      if (before[b] == 0) continue;
      const auto here = static_cast<Index>(owners_[b][before[b] - 1] + 1);
      if (owner != 0 && owner != here) return kMixed;
      owner = here;
    }
    if (owner == 0) return 0;
    for (std::size_t b = 0; b < before.size(); ++b) {
      const bool owns =
          std::find(owners_[b].begin(), owners_[b].end(), owner - 1) != owners_[b].end();
      if (owns != (before[b] != 0)) return kMixed;
    }
    return owner;
  }

  void add(ProblemBuilder& builder, std::span<const Index> tuple, int before, double cost) {
    const Index owner = owner_of(tuple.first(static_cast<std::size_t>(before)));
    if (owner == kMixed) return;
    arc_.assign(1, owner);
    arc_.insert(arc_.end(), tuple.begin() + before, tuple.end());
    builder.add_arc(arc_, cost);
  }

  static constexpr Index kMixed = ~Index{0};

  const TrackingOptions options_;
  const int history_;
  std::vector<Scan> scans_;
  std::vector<Track> tracks_;
  std::vector<std::vector<std::size_t>> owners_;  // [scan before the window][visible detection]
  std::vector<Index> arc_;
};

}  // namespace

SlidingWindows scan_windows(TrackingOptions options, int moves) {
  SlidingWindows sliding;
  options.scenario_scans = options.scans + moves;
  for (options.first_scan = 0; options.first_scan <= moves; ++options.first_scan)
    sliding.windows.push_back(generate_tracking(options).problem);
  return sliding;
}

SlidingWindows track_windows(const TrackingOptions& options, int moves, int history) {
  SlidingWindows sliding;
  sliding.has_tracks = true;
  Tracker tracker(options, moves + history, history);
  for (int first = 0; first <= moves + history; ++first) {
    Problem window = tracker.window(first);
    tracker.follow(first, solve(window).solutions.front().arcs);
    if (first >= history) sliding.windows.push_back(std::move(window));
  }
  return sliding;
}

}  // namespace nda::bench
