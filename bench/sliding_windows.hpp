#pragma once

#include <vector>

#include "nda/generate.hpp"
#include "nda/problem.hpp"

namespace nda::bench {

/// Windows of the same length, each one scan after the one before it, cut out of one scenario.
struct SlidingWindows {
  std::vector<Problem> windows;
  /// Whether dimension 0 is the list of established tracks.  Those of a window keep their index in
  /// the next one, where the list is longer by the tracks that the scan between the two
  /// established.
  bool has_tracks = false;
};

/// `moves` + 1 windows of scans alone: what generate_tracking() makes of first_scan 0, 1, ...
SlidingWindows scan_windows(TrackingOptions options, int moves);

/// The same with the established tracks as dimension 0, as trackers have it (Capponi and de Waard,
/// "W-sliding window"; AFOSR report, section 3): the best solution of a window fixes what its first
/// scan belongs to, and hypotheses may use detections before the window only as the track that owns
/// them.  They are scored over the last `history` scans before the window.  An established track
/// that goes on with nothing costs its singleton.
SlidingWindows track_windows(const TrackingOptions& options, int moves, int history = 3);

}  // namespace nda::bench
