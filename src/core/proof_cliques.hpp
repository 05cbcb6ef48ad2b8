#pragma once

#include <cstdint>
#include <vector>

namespace nda::core {

/// Arcs that gain something, by the indices they use: no two that share one go together.
struct CliqueTask {
  std::vector<double> gain;                         ///< [arc] > 0, rounded up
  std::vector<std::vector<std::uint32_t>> indices;  ///< [arc]
};

/// What no choice of arcs gains more than, or `target` if none gains more than that: rounded up.
/// @param work  counted up by what is looked at, as in least_rise(); throws ProofFault beyond
///              `most_work`, or where there are too many arcs or the gains are no finite numbers.
double most_gain(const CliqueTask& task, double target, double& work, double most_work);

}  // namespace nda::core
