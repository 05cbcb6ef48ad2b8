#include "cli/progress_log.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace nda::cli {
void ProgressLog::operator()(const Progress& progress) {
  const double open = progress.cost - progress.lower_bound;
  const double gap = std::isfinite(open) ? open / std::max(1e-9, std::abs(progress.cost)) : open;
  const bool closes = !closed_ && gap <= 1e-12;
  const bool ends =
      !ended_ && progress.num_components > 0 && progress.components_done == progress.num_components;
  if (progress.seconds < next_seconds_ && !closes && !ends) return;
  closed_ = closed_ || closes;
  ended_ = ended_ || ends;
  next_seconds_ = progress.seconds + interval_s_;
  if (!started_)
    out_ << "   time (s)               cost        lower bound      gap %    done  event\n";
  started_ = true;
  char line[160];
  std::snprintf(line,
                sizeof line,
                "%11.3f %18.6f %18.6f %10.4f %7zu  %s\n",
                progress.seconds,
                progress.cost,
                progress.lower_bound,
                100 * gap,
                progress.components_done,
                progress.event);
  out_ << line << std::flush;
}

}  // namespace nda::cli
