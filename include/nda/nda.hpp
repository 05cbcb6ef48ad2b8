#pragma once

/// The whole public face of the library.

#include "nda/assign2d.hpp"
#include "nda/assign2d_k_best.hpp"
#include "nda/baselines.hpp"
#include "nda/check.hpp"
#include "nda/generate.hpp"
#include "nda/io.hpp"
#include "nda/k_best.hpp"
#include "nda/marginals.hpp"
#include "nda/options.hpp"
#include "nda/problem.hpp"
#include "nda/proof.hpp"
#include "nda/solution.hpp"
#include "nda/solve.hpp"
#include "nda/types.hpp"
#include "nda/version.hpp"
#include "nda/warm_start.hpp"
