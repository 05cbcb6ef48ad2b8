#include "nda/assign2d.hpp"

#include <algorithm>
#include <string>

#include "assign2d/auction.hpp"
#include "assign2d/dense_input.hpp"
#include "assign2d/network_simplex.hpp"
#include "assign2d/shortest_path.hpp"

namespace nda {
namespace {

[[noreturn]] void reject(const char* name, std::size_t at, const std::string& fault) {
  throw InputError(std::string(name) + "[" + std::to_string(at) + "] " + fault);
}

void require_rows(const Assign2dProblem& problem) {
  const std::span<const std::uint32_t> start = problem.row_start;
  if (start.size() != problem.row_outside.size() + 1) {
    throw InputError("row_start has " + std::to_string(start.size()) + " entries for " +
                     std::to_string(problem.row_outside.size()) + " rows");
  }
  if (problem.column.size() != problem.cost.size()) {
    throw InputError("column has " + std::to_string(problem.column.size()) + " entries, cost " +
                     std::to_string(problem.cost.size()));
  }
  if (start.front() != 0) reject("row_start", 0, "is not 0");
  for (std::size_t i = 1; i < start.size(); ++i) {
    if (start[i] < start[i - 1]) reject("row_start", i, "is less than the entry before");
  }
  if (start.back() != problem.column.size()) {
    reject("row_start", start.size() - 1, "is not the number of pairs");
  }
}

void require_columns(const Assign2dProblem& problem) {
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    for (std::uint32_t k = problem.row_start[i]; k < problem.row_start[i + 1]; ++k) {
      const std::string value = std::to_string(problem.column[k]);
      if (problem.column[k] >= problem.num_columns()) {
        reject("column", k, "is " + value + " of " + std::to_string(problem.num_columns()));
      }
      if (k > problem.row_start[i] && problem.column[k] <= problem.column[k - 1]) {
        reject("column",
               k,
               "is " + value + ", not above the entry before in row " + std::to_string(i));
      }
    }
  }
}

void require_bounds(const char* name,
                    std::span<const UseBounds> bounds,
                    std::span<const double> outside) {
  if (bounds.empty()) return;
  if (bounds.size() != outside.size()) {
    throw InputError(std::string(name) + " has " + std::to_string(bounds.size()) + " entries for " +
                     std::to_string(outside.size()));
  }
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (bounds[i].lo > bounds[i].hi) reject(name, i, "has lo above hi");
    if (bounds[i].lo == UseBounds::kUnlimited) reject(name, i, "has an unlimited lo");
    if (bounds[i].hi == UseBounds::kUnlimited && outside[i] < 0)
      reject(name, i, "is unlimited where the outside cost is negative");
  }
}

bool are_all_once(std::span<const UseBounds> bounds) {
  return std::all_of(
      bounds.begin(), bounds.end(), [](const UseBounds& of) { return of == UseBounds{}; });
}

// Bounds of 1..1 are no bounds.
void require_known_bounds(Assign2dProblem& problem, Assign2dMethod method) {
  if (are_all_once(problem.row_bounds) && are_all_once(problem.column_bounds))
    problem.row_bounds = problem.column_bounds = {};
  if (problem.has_bounds() && method != Assign2dMethod::kNetworkSimplex)
    throw InputError(
        "the two-dimensional method needs bounds of 1..1; network simplex knows others");
}

}  // namespace

void validate(const Assign2dProblem& problem) {
  require_rows(problem);
  require_columns(problem);
  lap::require_costs("cost", problem.cost);
  lap::require_costs("row_outside", problem.row_outside);
  lap::require_costs("column_outside", problem.column_outside);
  require_bounds("row_bounds", problem.row_bounds, problem.row_outside);
  require_bounds("column_bounds", problem.column_bounds, problem.column_outside);
}

std::unique_ptr<Assign2dSolver> make_assign2d_solver(Assign2dMethod method) {
  switch (method) {
    case Assign2dMethod::kShortestPath:
      return std::make_unique<lap::ShortestPathSolver>();
    case Assign2dMethod::kAuction:
      return std::make_unique<lap::AuctionSolver>();
    case Assign2dMethod::kNetworkSimplex:
      return std::make_unique<lap::NetworkSimplexSolver>();
  }
  throw InputError("unknown two-dimensional method " + std::to_string(static_cast<int>(method)));
}

Assign2dResult assign2d(const Assign2dProblem& problem, Assign2dMethod method) {
  validate(problem);
  Assign2dProblem known = problem;
  require_known_bounds(known, method);
  Assign2dResult result;
  make_assign2d_solver(method)->solve(known, result);
  return result;
}

Assign2dResult assign2d(std::span<const double> cost_row_major,
                        std::uint32_t num_rows,
                        std::uint32_t num_columns,
                        Assign2dMethod method) {
  const lap::DenseInput input(cost_row_major, num_rows, num_columns);
  Assign2dResult result;
  if (method == Assign2dMethod::kShortestPath) {
    lap::ShortestPathSolver().solve_matrix({input.cost, input.row_outside, input.column_outside},
                                           result);
  } else {
    const lap::FullPattern pattern(num_rows, num_columns);
    make_assign2d_solver(method)->solve(
        {pattern.row_start, pattern.column, input.cost, input.row_outside, input.column_outside},
        result);
  }
  return result;
}

}  // namespace nda
