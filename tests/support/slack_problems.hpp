#pragma once

#include <cstdint>
#include <vector>

#include "bnb/slack_search.hpp"
#include "core/random.hpp"

namespace nda::support {

/// Any rows and arcs, 13 arcs at most; prices 0 or not, some rows that must be used up, up to three
/// cuts.
bnb::SlackProblem random_slack_problem(core::Random& random);

/// The slack of a set of arcs; +inf where two share an index.
double slack_of(const bnb::SlackProblem& problem, const std::vector<std::uint32_t>& arcs);

/// That of every set of arcs, ascending.
std::vector<double> all_slacks(const bnb::SlackProblem& problem);

}  // namespace nda::support
