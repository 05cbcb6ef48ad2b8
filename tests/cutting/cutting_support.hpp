#pragma once

#include <span>
#include <vector>

#include "core/component.hpp"
#include "core/random.hpp"
#include "cutting/master.hpp"
#include "support/components.hpp"

namespace nda::cutting {

inline std::vector<double> no_multipliers(const core::Component& component) {
  return std::vector<double>(component.num_slots(), 0.0);
}

/// A dense component of three or four dimensions: its linear relaxation is rarely integral.
inline core::Component fractional_component(std::uint64_t seed) {
  support::RandomComponentOptions options;
  options.sizes = seed % 2 == 0 ? std::vector<Index>{4, 4, 4} : std::vector<Index>{3, 3, 3, 3};
  options.num_arcs = 22;
  options.dummy_share = 0.2;
  options.integer = seed % 3 == 0;
  return support::random_component(seed, options);
}

/// Each pair of three indices at -1: fractional optimum -1.5, best packing -1.
inline core::Component triangle() {
  core::Component component = core::make_component({1, 1, 1});
  core::append_arc(component, std::vector<Index>{0, 1, 1}, -1);
  core::append_arc(component, std::vector<Index>{1, 0, 1}, -1);
  core::append_arc(component, std::vector<Index>{1, 1, 0}, -1);
  return component;
}

}  // namespace nda::cutting
