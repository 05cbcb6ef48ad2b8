#pragma once

#include <ostream>

#include "nda/options.hpp"

namespace nda::cli {

/// Writes a solver log, one line at a time: seconds, cost, bound, gap, what found it.
/// At most one line every `interval_s` seconds, but the one that closes the gap, and the one that
/// ends the last component, always; at least one every second or so, as the solver reports
/// "working" where nothing improves.
class ProgressLog {
 public:
  ProgressLog(std::ostream& out, double interval_s) : out_(out), interval_s_(interval_s) {}

  void operator()(const Progress& progress);

 private:
  std::ostream& out_;
  double interval_s_;
  double next_seconds_ = 0;
  bool started_ = false;
  bool closed_ = false;
  bool ended_ = false;
};

}  // namespace nda::cli
