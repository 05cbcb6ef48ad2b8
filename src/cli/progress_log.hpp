#pragma once

#include <ostream>

#include "nda/options.hpp"

namespace nda::cli {

/// Writes a solver log, one line at a time: seconds, cost, bound, gap, what found it.
/// At most ten lines a second, but the first and those that close the gap always.
class ProgressLog {
 public:
  explicit ProgressLog(std::ostream& out) : out_(out) {}

  void operator()(const Progress& progress);

 private:
  std::ostream& out_;
  double next_seconds_ = 0;
  bool started_ = false;
};

}  // namespace nda::cli
