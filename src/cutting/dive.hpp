#pragma once

#include "core/clock.hpp"
#include "core/component.hpp"
#include "core/random.hpp"
#include "cutting/master.hpp"

namespace nda::cutting {

/// Dives from the solved point of a master to a packing: takes the arcs with the largest values,
/// disturbed at random, forbids what excludes them, solves the linear program of what is left, and
/// so on.  The master is solved again afterwards, its point the one it was.  Empty where the
/// deadline strikes.
core::Packing dive(const core::Component& component,
                   Master& master,
                   core::Random& random,
                   const core::Deadline& deadline);

}  // namespace nda::cutting
