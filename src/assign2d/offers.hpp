#pragma once

#include <cstdint>

#include "assign2d/side.hpp"

namespace nda::lap {

/// The two best of min(outside, c - dual of the partner) for a member.
struct Offers {
  double first;
  double second;                     ///< +inf if there is only one
  std::uint32_t first_pair = kNone;  ///< as the view counts; kNone = outside option
  std::uint32_t second_pair = kNone;
};

template <class View>
Offers best_offers(const Phase<View>& phase, std::uint32_t i) {
  const View& view = phase.view;
  Offers best{phase.own.outside[i], kInfinity};
  for (std::uint32_t k = view.start[i]; k < view.start[i + 1]; ++k) {
    const double offer = view.cost(k) - phase.other.dual[view.partner[k]];
    if (!(offer < best.second)) continue;
    if (offer < best.first) {
      best = {offer, best.first, k, best.first_pair};
    } else {
      best.second = offer;
      best.second_pair = k;
    }
  }
  return best;
}

}  // namespace nda::lap
