#include "kbest/packing_sums.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "kbest/combinations.hpp"
#include "kbest/packing_buffer.hpp"
#include "kbest/sums.hpp"

namespace nda::kbest {

std::vector<PackingChoice> cheapest_choices(const std::vector<std::vector<core::Packing>>& lists,
                                            std::size_t k,
                                            const core::Deadline& deadline) {
  std::vector<PackingChoice> choices;
  if (std::ranges::any_of(lists, [](const auto& list) { return list.empty(); })) return choices;
  Combinations combinations;
  PackingChoice members;  // what a leaf stands for
  std::vector<RankedList> ranked(lists.size());
  std::vector<const RankedList*> pointers;
  for (std::size_t list = 0; list < lists.size(); ++list) {
    for (std::size_t i = 0; i < lists[list].size(); ++i) {
      const auto leaf = static_cast<std::uint32_t>(members.size());
      members.emplace_back(list, i);
      ranked[list].push_back({lists[list][i].cost, combinations.single(leaf)});
    }
    pointers.push_back(&ranked[list]);
  }
  Sums sums(std::move(pointers), combinations);
  while (choices.size() < k && (choices.size() < kFewPackings || !deadline.reached())) {
    const std::optional<Ranked> next = sums.next();
    if (!next) break;
    PackingChoice& choice = choices.emplace_back();
    for (const std::uint32_t leaf : combinations.arcs(next->arcs)) choice.push_back(members[leaf]);
  }
  return choices;
}

}  // namespace nda::kbest
