#include "generate/grid.hpp"

#include <cmath>

// One counting sort.  Cells are made wider where there would be many more of them than detections.

namespace nda::generate {

Grid::Grid(const Scan& scan, double cell) : cell_(cell) {
  if (!scan.empty()) {
    const auto by_y = std::minmax_element(
        scan.begin(), scan.end(), [](const Point& a, const Point& b) { return a.y < b.y; });
    origin_ = {scan.front().x, by_y.first->y};
    const double width = scan.back().x - origin_.x;
    const double height = by_y.second->y - origin_.y;
    const double per_side = std::sqrt(16 + 4 * static_cast<double>(scan.size()));
    cell_ = std::max(cell, std::max(width, height) / per_side);
    num_columns_ = 1 + static_cast<std::int64_t>(width / cell_);
    num_rows_ = 1 + static_cast<std::int64_t>(height / cell_);
  }
  start_.assign(static_cast<std::size_t>(num_rows_ * num_columns_) + 1, 0);
  const auto cell_of = [&](const Point& p) {
    return static_cast<std::size_t>(row_of(p.y) * num_columns_ + column_of(p.x));
  };
  for (const Point& p : scan) ++start_[cell_of(p) + 1];
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
  entries_.resize(scan.size());
  for (std::size_t j = 0; j < scan.size(); ++j) {
    entries_[next[cell_of(scan[j])]++] = {scan[j], static_cast<std::uint32_t>(j)};
  }
}

}  // namespace nda::generate
