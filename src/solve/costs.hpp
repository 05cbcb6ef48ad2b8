#pragma once

#include <string>

#include "nda/problem.hpp"
#include "nda/solution.hpp"

namespace nda::pipeline {

/// Beyond this sums and squares of costs might overflow.
inline constexpr double kLargestCost = 1e100;

/// Largest |c| of arcs and allowed singletons; 0 if there is none.
double largest_cost(const Problem& problem);

/// Least |c| > 0 of the same; 0 if there is none.
double smallest_cost(const Problem& problem);

/// How far the rounding of costs off the grid may let a solution seem cheaper than one that costs
/// `cost`: by 2^-52 of all absolute costs of the two.
double off_grid(const Problem& problem, double cost);

/// A cost for a sentence: three digits.
std::string figure_text(double figure);

/// Too small to matter beside the cost of a solution or beside any cost there is.
bool is_negligible(const Problem& problem, double difference, double cost);

/// Why a search to its end proves nothing: differences of costs by `error` are lost.
std::string rounding_reason(double error);

/// Why nothing is searched where costs are as large as that.
std::string overflow_reason(double largest);

/// The answer where costs as large as `largest` overflow: nothing can be computed but what leaving
/// every index alone costs, if it may be.
Solution overflow(const Problem& problem, double largest);

}  // namespace nda::pipeline
