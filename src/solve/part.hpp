#pragma once

#include <memory>
#include <optional>

#include "bnb/proof_log.hpp"
#include "core/component.hpp"
#include "nda/solution.hpp"
#include "solve/component_solver.hpp"
#include "solve/settling.hpp"

namespace nda::pipeline {

/// One component and its solver, kept between the rounds.
struct Part {
  core::Component component;
  std::unique_ptr<bnb::ProofLog> proof;  // null when none is asked for
  std::optional<SettledComponent> settled;
  std::unique_ptr<ComponentSolver> solver;  // null where settled

  bool is_known() const { return settled || solver != nullptr; }
  const ComponentState& state() const { return settled ? settled->state : solver->state(); }
  const Precision& precision() const { return settled ? settled->precision : solver->precision(); }
};

/// Adds what was done with a part that is known; what reductions did is counted by the Settler.
void count(const Part& part, Stats& stats);

}  // namespace nda::pipeline
