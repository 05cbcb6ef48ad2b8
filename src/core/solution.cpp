#include "nda/solution.hpp"

#include <algorithm>
#include <cmath>

namespace nda {

const char* to_string(Status status) {
  switch (status) {
    case Status::kOptimal:
      return "optimal";
    case Status::kGapReached:
      return "gap_reached";
    case Status::kTimeLimit:
      return "time_limit";
    case Status::kIterationLimit:
      return "iteration_limit";
    case Status::kNodeLimit:
      return "node_limit";
    case Status::kInterrupted:
      return "interrupted";
    case Status::kInfeasible:
      return "infeasible";
    case Status::kPrecisionLost:
      return "precision_lost";
  }
  return "unknown";
}

double Solution::gap() const {
  if (!std::isfinite(cost) || !std::isfinite(lower_bound)) return kInfinity;
  return std::max(0.0, cost - lower_bound);
}

double Solution::relative_gap() const {
  const double absolute = gap();
  return std::isinf(absolute) ? absolute : absolute / std::max(1e-9, std::abs(cost));
}

ReductionYield& ReductionYield::operator+=(const ReductionYield& other) {
  components += other.components;
  arcs += other.arcs;
  dominated += other.dominated;
  redundant += other.redundant;
  outweighing += other.outweighing;
  excluded += other.excluded;
  single += other.single;
  unprofitable += other.unprofitable;
  sides += other.sides;
  side_arcs += other.side_arcs;
  left += other.left;
  return *this;
}

FixingYield& FixingYield::operator+=(const FixingYield& other) {
  dropped += other.dropped;
  taken += other.taken;
  splits += other.splits;
  parts += other.parts;
  return *this;
}

}  // namespace nda
