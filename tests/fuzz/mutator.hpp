#pragma once

#include <string>
#include <vector>

#include "core/random.hpp"

namespace nda::fuzz {

/// Changes a text a little, as an editor or a broken disk would: bytes flipped, inserted and
/// removed, pieces copied, numbers replaced by ones at the limits of types, words of the formats
/// inserted, pieces of another seed taken over.  Deterministic for a given state of `random`.
std::string mutated(const std::string& text,
                    const std::vector<std::string>& seeds,
                    core::Random& random);

}  // namespace nda::fuzz
