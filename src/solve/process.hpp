#pragma once

#include <cstddef>

namespace nda::pipeline {

/// Largest resident set of this process so far; 0 where the system does not tell.
std::size_t peak_memory_bytes();

}  // namespace nda::pipeline
