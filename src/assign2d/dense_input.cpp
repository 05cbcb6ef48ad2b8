#include "assign2d/dense_input.hpp"

#include <cmath>
#include <string>

namespace nda::lap {

void require_costs(const char* name, std::span<const double> costs) {
  for (std::size_t at = 0; at < costs.size(); ++at) {
    if (costs[at] > -kInfinity) continue;
    throw InputError(std::string(name) + "[" + std::to_string(at) + "] is " +
                     (std::isnan(costs[at]) ? "NaN" : "-inf"));
  }
}

DenseInput::DenseInput(std::span<const double> cost_row_major,
                       std::uint32_t num_rows,
                       std::uint32_t num_columns)
    : cost(cost_row_major) {
  if (cost.size() != std::size_t{num_rows} * num_columns) {
    throw InputError("cost_row_major has " + std::to_string(cost.size()) + " entries, not " +
                     std::to_string(num_rows) + " x " + std::to_string(num_columns));
  }
  require_costs("cost_row_major", cost);
  row_outside.assign(num_rows, num_rows > num_columns ? 0 : kInfinity);
  column_outside.assign(num_columns, num_columns > num_rows ? 0 : kInfinity);
}

FullPattern::FullPattern(std::uint32_t num_rows, std::uint32_t num_columns) {
  column.reserve(std::size_t{num_rows} * num_columns);
  for (std::uint32_t i = 0; i < num_rows; ++i) {
    for (std::uint32_t j = 0; j < num_columns; ++j) column.push_back(j);
    row_start.push_back(static_cast<std::uint32_t>(column.size()));
  }
}

}  // namespace nda::lap
