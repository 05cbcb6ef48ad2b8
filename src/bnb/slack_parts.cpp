#include "bnb/slack_parts.hpp"

#include <algorithm>
#include <numeric>

#include "core/find_set.hpp"

// Arcs are joined by the indices they share, whether these have a price or not, and by open cuts.

namespace nda::bnb {

void Parts::copy(std::size_t part,
                 const std::vector<OpenArc>& arcs,
                 const std::vector<OpenRow>& rows,
                 std::vector<OpenArc>& part_arcs,
                 std::vector<OpenRow>& part_rows) const {
  part_arcs.clear();
  part_arcs.reserve(arcs.size());
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    if (arc_part_[i] == part) part_arcs.push_back(arcs[i]);
  }
  part_rows.clear();
  part_rows.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (row_part_[i] == part) part_rows.push_back(rows[i]);
  }
}

bool PartFinder::split(const std::vector<OpenArc>& arcs,
                       const std::vector<OpenRow>& rows,
                       Parts& parts) {
  join(arcs, rows);
  label(rows);
  parts.num_ = size_.size();
  if (parts.num_ < 2) return false;
  parts.arc_part_.resize(arcs.size());
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    parts.arc_part_[i] = part_of(arcs[i].arc);
    if (parts.arc_part_[i] != kNoPart) ++size_[parts.arc_part_[i]];
  }
  rank_by_size();
  for (std::uint32_t& part : parts.arc_part_) {
    if (part != kNoPart) part = rank_[part];
  }
  parts.row_part_.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    parts.row_part_[i] = rank_[label_[core::find_set(parent_, rows[i].row)]];
  return true;
}

void PartFinder::join(const std::vector<OpenArc>& arcs, const std::vector<OpenRow>& rows) {
  for (const OpenArc& arc : arcs) {
    for (const RowUse use : problem_.uses(arc.arc)) {
      parent_[use.row] = use.row < problem_.num_indices() ? use.row : kNoPart;
      label_[use.row] = kNoPart;
    }
  }
  for (const OpenRow& row : rows) {
    parent_[row.row] = row.row;
    label_[row.row] = kNoPart;
  }
  for (const OpenArc& arc : arcs) {
    std::uint32_t first = kNoPart;
    for (const RowUse use : problem_.uses(arc.arc)) {
      if (parent_[use.row] == kNoPart) continue;
      const std::uint32_t root = core::find_set(parent_, use.row);
      if (first == kNoPart) first = root;
      parent_[root] = first;
    }
  }
}

// Numbers the parts that have open rows.
void PartFinder::label(const std::vector<OpenRow>& rows) {
  size_.clear();
  for (const OpenRow& row : rows) {
    std::uint32_t& label = label_[core::find_set(parent_, row.row)];
    if (label != kNoPart) continue;
    label = static_cast<std::uint32_t>(size_.size());
    size_.push_back(0);
  }
}

std::uint32_t PartFinder::part_of(std::uint32_t arc) {
  for (const RowUse use : problem_.uses(arc)) {
    if (parent_[use.row] != kNoPart) return label_[core::find_set(parent_, use.row)];
  }
  return kNoPart;
}

void PartFinder::rank_by_size() {
  std::vector<std::uint32_t> order(size_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return size_[a] < size_[b];
  });
  rank_.resize(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) rank_[order[i]] = i;
}

}  // namespace nda::bnb
