#include "nda/assign2d.hpp"

#include <cmath>
#include <string>

#include "assign2d/auction.hpp"
#include "assign2d/network_simplex.hpp"
#include "assign2d/shortest_path.hpp"

namespace nda {
namespace {

[[noreturn]] void reject(const char* name, std::size_t at, const std::string& fault) {
  throw InputError(std::string(name) + "[" + std::to_string(at) + "] " + fault);
}

void require_costs(const char* name, std::span<const double> costs) {
  for (std::size_t at = 0; at < costs.size(); ++at) {
    if (std::isnan(costs[at])) reject(name, at, "is NaN");
    if (costs[at] == -kInfinity) reject(name, at, "is -inf");
  }
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

// The sparsity pattern of a full matrix.
struct FullPattern {
  FullPattern(std::uint32_t num_rows, std::uint32_t num_columns) {
    column.reserve(std::size_t{num_rows} * num_columns);
    for (std::uint32_t i = 0; i < num_rows; ++i) {
      for (std::uint32_t j = 0; j < num_columns; ++j) column.push_back(j);
      row_start.push_back(static_cast<std::uint32_t>(column.size()));
    }
  }

  std::vector<std::uint32_t> row_start = {0};
  std::vector<std::uint32_t> column;
};

}  // namespace

void validate(const Assign2dProblem& problem) {
  require_rows(problem);
  require_columns(problem);
  require_costs("cost", problem.cost);
  require_costs("row_outside", problem.row_outside);
  require_costs("column_outside", problem.column_outside);
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
  Assign2dResult result;
  make_assign2d_solver(method)->solve(problem, result);
  return result;
}

Assign2dResult assign2d(std::span<const double> cost_row_major,
                        std::uint32_t num_rows,
                        std::uint32_t num_columns,
                        Assign2dMethod method) {
  if (cost_row_major.size() != std::size_t{num_rows} * num_columns) {
    throw InputError("cost_row_major has " + std::to_string(cost_row_major.size()) +
                     " entries, not " + std::to_string(num_rows) + " x " +
                     std::to_string(num_columns));
  }
  require_costs("cost_row_major", cost_row_major);
  const std::vector<double> row_outside(num_rows, num_rows > num_columns ? 0 : kInfinity);
  const std::vector<double> column_outside(num_columns, num_columns > num_rows ? 0 : kInfinity);
  Assign2dResult result;
  if (method == Assign2dMethod::kShortestPath) {
    lap::ShortestPathSolver().solve_matrix({cost_row_major, row_outside, column_outside}, result);
  } else {
    const FullPattern pattern(num_rows, num_columns);
    make_assign2d_solver(method)->solve(
        {pattern.row_start, pattern.column, cost_row_major, row_outside, column_outside}, result);
  }
  return result;
}

}  // namespace nda
