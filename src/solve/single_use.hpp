#pragma once

#include <string>

#include "nda/problem.hpp"

namespace nda::pipeline {

/// Throws InputError naming the first index with bounds other than 1..1: `what` needs that every
/// index is to be used once.
void require_single_use(const Problem& problem, const std::string& what);

}  // namespace nda::pipeline
