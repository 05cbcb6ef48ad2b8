#pragma once

#include <cstddef>

#include "nda/solution.hpp"

namespace nda::cli {

/// Prints Solution::marginals, which there are: what they are about, the ambiguous indices with
/// their uses, and the arcs that only some of the ranks have.
/// @param k        how many solutions were asked for
/// @param seconds  what computing them took
/// @param all      every line, instead of the first of each table
void print_marginals(const Solution& solution, double seconds, bool all);

}  // namespace nda::cli
