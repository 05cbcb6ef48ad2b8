#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "nda/assign2d.hpp"

namespace nda::support {

/// A problem that owns its arrays.
struct OwnedProblem {
  std::vector<std::uint32_t> row_start = {0};
  std::vector<std::uint32_t> column = {};
  std::vector<double> cost = {};
  std::vector<double> row_outside = {};
  std::vector<double> column_outside = {};

  Assign2dProblem view() const { return {row_start, column, cost, row_outside, column_outside}; }
};

/// From a matrix with absent pairs: `absent` entries are not stored, +inf entries are.
inline constexpr double kAbsent = -1e300;

inline OwnedProblem from_matrix(const std::vector<std::vector<double>>& matrix,
                                std::vector<double> row_outside,
                                std::vector<double> column_outside) {
  OwnedProblem problem;
  for (const std::vector<double>& row : matrix) {
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (row[j] == kAbsent) continue;
      problem.column.push_back(static_cast<std::uint32_t>(j));
      problem.cost.push_back(row[j]);
    }
    problem.row_start.push_back(static_cast<std::uint32_t>(problem.column.size()));
  }
  problem.row_outside = std::move(row_outside);
  problem.column_outside = std::move(column_outside);
  return problem;
}

/// What a random problem looks like.
struct Recipe {
  std::uint32_t num_rows = 0;
  std::uint32_t num_columns = 0;
  double density = 1;       ///< share of pairs stored
  double forbidden = 0;     ///< share of stored pairs of cost +inf
  double must_rows = 0;     ///< share of rows with outside cost +inf
  double must_columns = 0;  ///< share of columns with outside cost +inf
  double lowest = -10;      ///< of all costs
  double highest = 10;
  double outside_factor = 1;  ///< outside costs lie in this multiple of the range
  bool integer = false;       ///< costs rounded to integers, so that ties abound
};

using Random = std::mt19937_64;

/// In [0, 1), the same on every platform.
inline double uniform(Random& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

inline std::uint32_t below(Random& random, std::uint32_t n) {
  return static_cast<std::uint32_t>(random() % n);
}

inline double random_cost(const Recipe& recipe, Random& random) {
  const double x = recipe.lowest + (recipe.highest - recipe.lowest) * uniform(random);
  return recipe.integer ? std::floor(x) : x;
}

inline OwnedProblem random_problem(const Recipe& recipe, Random& random) {
  OwnedProblem problem;
  for (std::uint32_t i = 0; i < recipe.num_rows; ++i) {
    for (std::uint32_t j = 0; j < recipe.num_columns; ++j) {
      if (uniform(random) >= recipe.density) continue;
      problem.column.push_back(j);
      const bool forbidden = uniform(random) < recipe.forbidden;
      problem.cost.push_back(forbidden ? kInfinity : random_cost(recipe, random));
    }
    problem.row_start.push_back(static_cast<std::uint32_t>(problem.column.size()));
  }
  const auto outside = [&](double must) {
    return uniform(random) < must ? kInfinity : recipe.outside_factor * random_cost(recipe, random);
  };
  for (std::uint32_t i = 0; i < recipe.num_rows; ++i) {
    problem.row_outside.push_back(outside(recipe.must_rows));
  }
  for (std::uint32_t j = 0; j < recipe.num_columns; ++j) {
    problem.column_outside.push_back(outside(recipe.must_columns));
  }
  return problem;
}

/// Any mix of everything that a problem with sides up to `size` can be.
inline Recipe random_recipe(std::uint32_t size, Random& random) {
  static constexpr double kShares[] = {0, 0.3, 0.7, 1};
  static constexpr double kRanges[][2] = {
      {-10, 10}, {0, 1}, {-1, 0}, {-3, 3}, {-1e9, 1e9}, {0, 1e-9}, {1e9, 1.001e9}, {0, 0}};
  Recipe recipe;
  recipe.num_rows = below(random, size + 1);
  recipe.num_columns = below(random, size + 1);
  recipe.density = std::max(0.2, kShares[below(random, 4)]);
  recipe.forbidden = below(random, 3) == 0 ? 0.2 : 0;
  recipe.must_rows = kShares[below(random, 4)];
  recipe.must_columns = kShares[below(random, 4)];
  const auto& range = kRanges[below(random, 8)];
  recipe.lowest = range[0];
  recipe.highest = range[1];
  recipe.outside_factor = below(random, 4) == 0 ? 1000 : 1;
  recipe.integer = below(random, 2) == 0 && range[1] - range[0] > 2;
  return recipe;
}

}  // namespace nda::support
