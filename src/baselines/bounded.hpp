#pragma once

#include "nda/baselines.hpp"

namespace nda::baselines {

// What there is for problems with bounds on uses; results and refusals as in nda/baselines.hpp.

BaselineResult bounded_greedy(const Problem& problem);
BaselineResult bounded_brute_force(const Problem& problem);

}  // namespace nda::baselines
