#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "core/component.hpp"

namespace nda::kbest {

struct ArcsHash {
  std::size_t operator()(const std::vector<core::ArcId>& arcs) const {
    std::uint64_t hash = 0;
    for (const core::ArcId a : arcs) hash = (hash ^ a) * 0x9E3779B97F4A7C15u;
    return static_cast<std::size_t>(hash ^ hash >> 32);
  }
};

/// Sets of arcs, each ascending: whether one is among them takes as long as reading it.
using ArcSets = std::unordered_set<std::vector<core::ArcId>, ArcsHash>;

}  // namespace nda::kbest
