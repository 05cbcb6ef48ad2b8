#include "core/component.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/slices.hpp"

namespace nda::core {
namespace {

// What a Cutter cuts from: dimensions, slots, columns and costs.
struct ComponentSource {
  const Component& component;

  std::size_t num_dimensions() const { return component.sizes.size(); }
  std::size_t num_slots() const { return component.num_slots(); }
  std::uint32_t offset(std::size_t k) const { return component.offset[k]; }
  std::span<const Index> column(std::size_t k) const {
    return {component.indices[k].data(), component.num_arcs()};
  }
  double cost(ArcId a) const { return component.costs[a]; }
  ArcId arc_origin(ArcId a) const { return original_arc(component, a); }
  std::uint8_t dimension(std::size_t k) const { return component.dimensions[k]; }
  Index origin(std::size_t, std::uint32_t slot) const { return component.origin[slot]; }
};

struct ProblemSource {
  const Problem& problem;
  const Shift& shift;

  std::size_t num_dimensions() const { return problem.sizes().size(); }
  std::size_t num_slots() const { return problem.num_indices() + num_dimensions(); }
  std::uint32_t offset(std::size_t k) const { return shift.offset[k]; }
  std::span<const Index> column(std::size_t k) const {
    return problem.indices(static_cast<int>(k));
  }
  double cost(ArcId a) const { return shifted_cost(problem, shift, a); }
  ArcId arc_origin(ArcId a) const { return a; }
  std::uint8_t dimension(std::size_t k) const { return static_cast<std::uint8_t>(k); }
  Index origin(std::size_t k, std::uint32_t slot) const { return slot - offset(k); }
};

}  // namespace

double largest_cost(const Component& component) {
  double largest = 0;
  for (const double cost : component.costs) largest = std::max(largest, std::abs(cost));
  return largest;
}

Packing make_packing(const Component& component, std::vector<ArcId> arcs) {
  std::sort(arcs.begin(), arcs.end());
  Packing packing{std::move(arcs), 0};
  for (const ArcId a : packing.arcs) packing.cost += component.costs[a];
  return packing;
}

Component make_component(std::vector<Index> sizes) {
  Component component;
  component.sizes = std::move(sizes);
  std::uint32_t next = 0;
  for (std::size_t k = 0; k < component.sizes.size(); ++k) {
    component.offset.push_back(next);
    component.dimensions.push_back(static_cast<std::uint8_t>(k));
    for (Index i = 0; i <= component.sizes[k]; ++i) component.origin.push_back(i);
    next += component.sizes[k] + 1;
  }
  component.indices.resize(component.sizes.size());
  return component;
}

void append_arc(Component& component, std::span<const Index> tuple, double cost) {
  for (std::size_t k = 0; k < tuple.size(); ++k) component.indices[k].push_back(tuple[k]);
  component.costs.push_back(cost);
}

Component whole_problem(const Problem& problem, const Shift& shift, const Deadline& deadline) {
  Component component = make_component({problem.sizes().begin(), problem.sizes().end()});
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    component.indices[static_cast<std::size_t>(k)] = Column::borrow(problem.indices(k));
  }
  component.costs.reserve(problem.num_arcs());
  const auto copy_cost = [&](std::size_t a) {
    component.costs.push_back(shifted_cost(problem, shift, a));
  };
  if (!for_each_until(deadline, problem.num_arcs(), copy_cost)) return {};
  return component;
}

std::vector<ArcId> all_arcs(const Component& component) {
  std::vector<ArcId> arcs(component.num_arcs());
  std::iota(arcs.begin(), arcs.end(), 0u);
  return arcs;
}

std::vector<ArcId> positions_in(std::span<const ArcId> ascending, std::span<const ArcId> arcs) {
  std::vector<ArcId> positions;
  for (const ArcId a : arcs) {
    const auto at = std::lower_bound(ascending.begin(), ascending.end(), a);
    if (at != ascending.end() && *at == a)
      positions.push_back(static_cast<ArcId>(at - ascending.begin()));
  }
  return positions;
}

std::vector<ArcId> at_positions(std::span<const ArcId> list, std::span<const ArcId> positions) {
  std::vector<ArcId> arcs;
  for (const ArcId position : positions) arcs.push_back(list[position]);
  return arcs;
}

Lists<ArcId> list_by_slot(const Component& component, std::span<const ArcId> arcs) {
  return {component.num_slots(), [&](auto&& visit) {
            for (const ArcId a : arcs)
              for_each_slot(component, a, [&](std::uint32_t slot) { visit(slot, a); });
          }};
}

std::vector<ArcId> arcs_from_original(const Component& component, std::vector<ArcId> originals) {
  std::sort(originals.begin(), originals.end());
  if (component.arc_origin.empty()) return originals;
  // Cutting keeps the order of arcs, so origins ascend.
  return positions_in(component.arc_origin, originals);
}

std::vector<ArcId> arcs_from_part(const Component& whole,
                                  const Component& part,
                                  std::vector<ArcId> arcs) {
  for (ArcId& a : arcs) a = original_arc(part, a);
  return arcs_from_original(whole, std::move(arcs));
}

namespace {

// Calls visit(slot of the whole, slot of the part) for every real index of a part.  Both list the
// origins of a dimension in ascending order: walk them side by side.
template <typename Visit>
void for_each_shared_slot(const Component& whole, const Component& part, Visit&& visit) {
  std::size_t k = 0;
  for (std::size_t p = 0; p < part.sizes.size(); ++p) {
    while (whole.dimensions[k] != part.dimensions[p]) ++k;
    std::uint32_t slot = whole.offset[k];
    for (Index i = 1; i <= part.sizes[p]; ++i) {
      const std::uint32_t wanted = part.offset[p] + i;
      do ++slot;
      while (whole.origin[slot] != part.origin[wanted]);
      visit(slot, wanted);
    }
  }
}

}  // namespace

std::vector<double> restrict_slots(const Component& whole,
                                   std::span<const double> values,
                                   const Component& part) {
  std::vector<double> restricted(part.num_slots(), 0.0);
  for_each_shared_slot(whole, part, [&](std::uint32_t slot, std::uint32_t part_slot) {
    restricted[part_slot] = values[slot];
  });
  return restricted;
}

std::vector<std::uint32_t> slots_in_part(const Component& whole, const Component& part) {
  std::vector<std::uint32_t> numbers(whole.num_slots(), 0);
  for_each_shared_slot(
      whole, part, [&](std::uint32_t slot, std::uint32_t part_slot) { numbers[slot] = part_slot; });
  return numbers;
}

void extend_slots(const Component& part,
                  std::span<const double> values,
                  const Component& whole,
                  std::span<double> extended) {
  for_each_shared_slot(whole, part, [&](std::uint32_t slot, std::uint32_t part_slot) {
    extended[slot] = values[part_slot];
  });
}

// Numbers the slots that the arcs use 1 and lists them, dummies like others: which index is one is
// a jump that is hard to foresee.
template <typename Source>
bool Cutter::find_used(const Source& source,
                       std::span<const ArcId> arcs,
                       const Deadline& deadline) {
  if (number_.size() < source.num_slots()) number_.resize(source.num_slots(), 0);
  for (std::size_t k = 0; k < source.num_dimensions(); ++k) {
    const std::span<const Index> column = source.column(k);
    const std::uint32_t offset = source.offset(k);
    const auto note = [&](std::size_t n) {
      const std::uint32_t slot = offset + column[arcs[n]];
      if (number_[slot] != 0) return;
      number_[slot] = 1;
      used_.push_back(slot);
    };
    if (!for_each_until(deadline, arcs.size(), note)) return false;
  }
  std::sort(used_.begin(), used_.end());
  return true;
}

// Numbers the used slots of every dimension from 1 on, dummies 0, and says where they came from.
template <typename Source>
void Cutter::number_used(const Source& source, Component& part) {
  auto next_used = used_.begin();
  for (std::size_t k = 0; k < source.num_dimensions(); ++k) {
    const std::uint32_t dummy = source.offset(k);
    const std::uint32_t end =
        k + 1 < source.num_dimensions() ? source.offset(k + 1) : ~std::uint32_t{0};
    number_[dummy] = 0;
    if (next_used != used_.end() && *next_used == dummy) ++next_used;
    if (next_used == used_.end() || *next_used >= end) continue;
    part.offset.push_back(static_cast<std::uint32_t>(part.origin.size()));
    part.dimensions.push_back(source.dimension(k));
    part.origin.push_back(0);
    Index size = 0;
    for (; next_used != used_.end() && *next_used < end; ++next_used) {
      number_[*next_used] = ++size;
      part.origin.push_back(source.origin(k, *next_used));
    }
    part.sizes.push_back(size);
  }
}

// Fills in columns, costs and origins once number_ holds the new numbers of the slots.
template <typename Source>
bool Cutter::copy_arcs(const Source& source,
                       std::span<const ArcId> arcs,
                       const Deadline& deadline,
                       Component& part) const {
  std::size_t p = 0;
  for (std::size_t k = 0; k < source.num_dimensions() && p < part.sizes.size(); ++k) {
    if (source.dimension(k) != part.dimensions[p]) continue;
    const std::span<const Index> column = source.column(k);
    const std::span<Index> copy = part.indices[p++].allocate(arcs.size());
    const Index* number = number_.data() + source.offset(k);
    const auto renumber = [&](std::size_t n) { copy[n] = number[column[arcs[n]]]; };
    if (!for_each_until(deadline, arcs.size(), renumber)) return false;
  }
  part.costs.resize(arcs.size());
  part.arc_origin.resize(arcs.size());
  return for_each_until(deadline, arcs.size(), [&](std::size_t n) {
    part.costs[n] = source.cost(arcs[n]);
    part.arc_origin[n] = source.arc_origin(arcs[n]);
  });
}

template <typename Source>
Component Cutter::cut_from(const Source& source,
                           std::span<const ArcId> arcs,
                           const Deadline& deadline) {
  Component part;
  if (find_used(source, arcs, deadline)) {
    number_used(source, part);
    part.indices.resize(part.sizes.size());
    if (!copy_arcs(source, arcs, deadline, part)) part = {};
  }
  for (const std::uint32_t slot : used_) number_[slot] = 0;
  used_.clear();
  return part;
}

Component Cutter::cut(const Component& source,
                      std::span<const ArcId> arcs,
                      const Deadline& deadline) {
  return cut_from(ComponentSource{source}, arcs, deadline);
}

Component Cutter::cut(const Problem& source,
                      const Shift& shift,
                      std::span<const ArcId> arcs,
                      const Deadline& deadline) {
  return cut_from(ProblemSource{source, shift}, arcs, deadline);
}

}  // namespace nda::core
