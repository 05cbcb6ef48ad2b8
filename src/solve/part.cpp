#include "solve/part.hpp"

namespace nda::pipeline {

void count(const Part& part, Stats& stats) {
  const ComponentState& state = part.state();
  stats.dual_evaluations += state.evaluations;
  stats.recoveries += state.recoveries;
  stats.nodes += state.nodes;
  stats.arcs_after_shift += part.component.num_arcs();
  stats.arcs_after_fixing += state.live_arcs;
  stats.arcs_left += state.left_arcs;
  stats.branching += state.branching;
  stats.searches += state.searches;
}

}  // namespace nda::pipeline
