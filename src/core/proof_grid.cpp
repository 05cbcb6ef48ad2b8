#include "core/proof_grid.hpp"

#include <algorithm>
#include <cmath>

// A cost of the part is a multiple of the grid, but for the rounding of its terms, of which there
// are at most as many as indices.

namespace nda::core {

ProofGrid::ProofGrid(double step, const PartArcs& arcs, const std::vector<double>& singletons)
    : step_(step) {
  if (!(step > 0)) return;
  const auto note = [&](double cost) {
    largest_ = std::max(largest_, std::abs(cost));
    exact_ = exact_ && std::fma(-std::nearbyint(cost / step), step, cost) == 0;
  };
  for (const double cost : arcs.cost) note(cost);
  for (const double cost : singletons) {
    if (cost < kInfinity) note(cost);
  }
}

double ProofGrid::rounded_up(double bound, std::size_t num_indices) const {
  if (!(step_ > 0)) return bound;
  const double error = exact_ ? 0 : 0x1p-50 * static_cast<double>(num_indices) * largest_;
  const double steps = (bound - error) / step_;
  if (!(std::abs(steps) < kMostGridSteps)) return bound;
  const double whole = std::ceil(steps - 0x1p-50 * std::abs(steps));
  const double product = whole * step_;
  const double up = exact_ && std::fma(whole, step_, -product) == 0
                        ? product
                        : std::nextafter(product, -kInfinity) - 2 * error;
  return std::max(bound, up);
}

}  // namespace nda::core
