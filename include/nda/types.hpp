#pragma once

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace nda {

/// Index i of a dimension: 1..M_k, or 0 for the dummy, which may be used any number of times.
using Index = std::uint32_t;

/// Cost of something that is forbidden.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Most dimensions a problem may have.
inline constexpr int kMaxDimensions = 64;

/// Bad input: a malformed file, an index out of range, a NaN cost, an option out of range.
///
/// The message names the place and the value ("line 12: index 9 of dimension 2 exceeds 7").
/// Nothing is half done when it is thrown.  Outcomes of a solve are never errors: see Status.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace nda
