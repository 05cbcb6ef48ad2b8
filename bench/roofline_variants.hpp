#pragma once

#include <span>
#include <vector>

#include "relax/collapse.hpp"

namespace nda::bench {

/// Other ways of relax::collapse() in five dimensions, measured and left out.  The values are the
/// same to the bit.
struct Variant {
  const char* name;
  void (*collapse)(const core::Component& component,
                   const relax::Cells& cells,
                   std::span<const double> u,
                   std::span<double> d,
                   std::span<core::ArcId> from);
};

/// Those that this processor can run.
std::vector<Variant> variants();

}  // namespace nda::bench
