#pragma once

#include <cstdint>
#include <vector>

#include "core/part_proof.hpp"

namespace nda::core {

/// A row of the search of a proof: an index, or a cut.  A unit of its capacity that no arc uses
/// costs its price.
struct SearchRow {
  double price = 0;  ///< >= 0, rounded down; +inf = must be used
  std::uint32_t capacity = 1;
};

/// An arc's coefficient in a row.
struct SearchEntry {
  std::uint32_t row;
  std::uint32_t coefficient;
};

/// Arcs that may be used at a cost of their own, rows with their prices.
struct SearchTask {
  std::vector<SearchRow> rows;
  std::uint32_t num_indices = 0;                  ///< the first rows; no two arcs share one
  std::vector<double> rise;                       ///< [arc] >= 0, rounded down
  std::vector<std::vector<SearchEntry>> entries;  ///< [arc]
};

/// The least cost of a choice of arcs that share no index, or `budget` if none costs less: rounded
/// down.
/// @param budget  finite, > 0.
/// @param work    counted up by the rows and entries looked at; throws ProofFault beyond
///                `most_work`, or where the search is too deep for the stack or too wide for
///                memory.
double least_rise(const SearchTask& task, double budget, double& work, double most_work);

}  // namespace nda::core
