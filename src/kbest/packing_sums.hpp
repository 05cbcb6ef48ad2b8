#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"

namespace nda::kbest {

/// One packing of each of several lists: (number of the list, number within it), both from 0.
using PackingChoice = std::vector<std::pair<std::size_t, std::size_t>>;

/// The k cheapest ways to choose one packing of each list, cheapest first.  The lists ascend by
/// cost; where one is empty there is no way.  The first few at least, and those before the
/// deadline.  Cost: O(lists log lists + k (log k + lists)).
std::vector<PackingChoice> cheapest_choices(const std::vector<std::vector<core::Packing>>& lists,
                                            std::size_t k,
                                            const core::Deadline& deadline = {});

}  // namespace nda::kbest
