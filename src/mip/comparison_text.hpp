#pragma once

#include <string>
#include <vector>

#include "mip/comparison.hpp"

namespace nda::mip {

/// The table of one file, a line per method; '*' marks the best cost and the best bound (all that
/// share it but for rounding).  Ends with a newline.  Columns: docs/compare.md.
std::string comparison_table(const FileComparison& comparison);

/// The table over all files, a line per method of the first one; all have the same methods.
std::string summary_table(const std::vector<FileComparison>& comparisons);

/// The line of names above the table of csv_rows(), with its newline.
std::string csv_header();

/// A row per method: everything in the tables, numbers with all their digits, missing ones empty.
std::string csv_rows(const FileComparison& comparison, double time_limit_s);

}  // namespace nda::mip
