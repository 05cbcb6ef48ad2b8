#include "nda/warm_start.hpp"

#include <algorithm>
#include <string>

namespace nda {
namespace {

// Removes `dropped` entries after the first `kept` and appends as many.
template <typename Entry>
void slide(std::vector<Entry>& row, std::size_t dropped, std::size_t kept) {
  if (row.size() <= kept) return;
  const std::size_t size = row.size();
  const auto first = row.begin() + static_cast<std::ptrdiff_t>(kept);
  row.erase(first, first + static_cast<std::ptrdiff_t>(std::min(dropped, size - kept)));
  row.resize(size);
}

void require_not_negative(const char* name, int value) {
  if (value >= 0) return;
  throw InputError(std::string("shift: ") + name + " is " + std::to_string(value) +
                   ", must be >= 0");
}

}  // namespace

void WarmStart::shift(int dimensions, int kept) {
  require_not_negative("dimensions", dimensions);
  require_not_negative("kept", kept);
  const auto dropped = static_cast<std::size_t>(dimensions);
  slide(multipliers, dropped, static_cast<std::size_t>(kept));
  for (std::vector<Index>& tuple : arcs) slide(tuple, dropped, static_cast<std::size_t>(kept));
  std::erase_if(arcs, [](const std::vector<Index>& tuple) {
    return std::all_of(tuple.begin(), tuple.end(), [](Index i) { return i == 0; });
  });
}

WarmStart warm_start(const Solution& solution) {
  WarmStart warm{solution.multipliers, {}};
  if (!solution.solutions.empty()) warm.arcs = solution.solutions.front().arcs;
  return warm;
}

}  // namespace nda
