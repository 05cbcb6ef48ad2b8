#include "solve/singletons.hpp"

namespace nda::pipeline {

std::vector<double> charges(const core::Component& component, const core::Shift& shift) {
  std::vector<double> charges(component.num_slots(), 0.0);
  core::for_each_index(component, [&](std::uint32_t slot, std::size_t k, Index i) {
    charges[slot] = shift.base[k][i];
  });
  return charges;
}

std::vector<bool> required_slots(const core::Component& component, const Problem& problem) {
  std::vector<bool> required(component.num_slots(), false);
  core::for_each_index(component, [&](std::uint32_t slot, std::size_t k, Index i) {
    required[slot] = problem.singleton_costs(static_cast<int>(k))[i] == kInfinity;
  });
  return required;
}

}  // namespace nda::pipeline
