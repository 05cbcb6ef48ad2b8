#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "generate/scenario.hpp"

namespace nda::generate {

/// The detections of a scan in square cells, for queries by distance.  O(detections) to build.
class Grid {
 public:
  /// @param cell  side of a cell; > 0
  Grid(const Scan& scan, double cell);

  /// Calls visit(j, squared distance) for every detection j within `radius` of `centre`.
  template <typename Visit>
  void for_each_within(Point centre, double radius, Visit&& visit) const {
    const std::int64_t left = column_of(centre.x - radius);
    const std::int64_t right = column_of(centre.x + radius);
    const std::int64_t top = row_of(centre.y + radius);
    for (std::int64_t row = row_of(centre.y - radius); row <= top; ++row) {
      const std::size_t begin = start_[static_cast<std::size_t>(row * num_columns_ + left)];
      const std::size_t end = start_[static_cast<std::size_t>(row * num_columns_ + right) + 1];
      for (std::size_t e = begin; e < end; ++e) {
        const double dx = entries_[e].point.x - centre.x;
        const double dy = entries_[e].point.y - centre.y;
        const double squared = dx * dx + dy * dy;
        if (squared <= radius * radius) visit(entries_[e].detection, squared);
      }
    }
  }

 private:
  struct Entry {
    Point point;
    std::uint32_t detection;
  };

  static std::int64_t clamped(double cell, std::int64_t count) {
    return cell <= 0                            ? 0
           : cell >= static_cast<double>(count) ? count - 1
                                                : static_cast<std::int64_t>(cell);
  }
  std::int64_t column_of(double x) const { return clamped((x - origin_.x) / cell_, num_columns_); }
  std::int64_t row_of(double y) const { return clamped((y - origin_.y) / cell_, num_rows_); }

  double cell_;
  Point origin_;
  std::int64_t num_columns_ = 1;
  std::int64_t num_rows_ = 1;
  std::vector<std::size_t> start_;  // [row * num_columns + column]: first entry of the cell
  std::vector<Entry> entries_;
};

}  // namespace nda::generate
