#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nda/assign2d.hpp"

namespace nda::lap {

/// Throws InputError naming the first cost that is NaN or -inf.
void require_costs(const char* name, std::span<const double> costs);

/// A full matrix with the outside options that linear_sum_assignment implies: every member of the
/// smaller side must be assigned, the others need not be.
struct DenseInput {
  /// Throws InputError for a matrix of another size, and for costs NaN or -inf.
  DenseInput(std::span<const double> cost_row_major,
             std::uint32_t num_rows,
             std::uint32_t num_columns);

  std::span<const double> cost;
  std::vector<double> row_outside;
  std::vector<double> column_outside;
};

/// The sparsity pattern of a full matrix.
struct FullPattern {
  FullPattern(std::uint32_t num_rows, std::uint32_t num_columns);

  std::vector<std::uint32_t> row_start = {0};
  std::vector<std::uint32_t> column;
};

}  // namespace nda::lap
