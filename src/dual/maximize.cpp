#include "dual/maximize.hpp"

#include "nda/types.hpp"

namespace nda::dual {

MaximizeResult maximize(DualMethod method,
                        ConcaveFunction& function,
                        std::span<const double> start,
                        const MaximizeOptions& options,
                        const Observer& observer) {
  switch (method) {
    case DualMethod::kBundleTrust:
      return maximize_bundle_trust(function, start, options, observer);
    case DualMethod::kSubgradient:
      return maximize_subgradient(function, start, options, observer);
    case DualMethod::kVolume:
      return maximize_volume(function, start, options, observer);
    case DualMethod::kCoordinate:
      break;
  }
  auto* const blocks = dynamic_cast<CoordinateFunction*>(&function);
  if (blocks == nullptr) throw InputError("dual method coordinate: the function has no blocks");
  return maximize_coordinate(*blocks, start, options, observer);
}

}  // namespace nda::dual
