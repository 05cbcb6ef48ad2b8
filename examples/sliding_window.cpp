#include <cstdio>

#include "nda/nda.hpp"

// Solves a window again and again as it slides over the scans of a scenario, each time from what
// the last solution knew.
int main() {
  nda::TrackingOptions scene;
  scene.scans = 5;            // of the window
  scene.scenario_scans = 12;  // of the scenario
  nda::WarmStart last;
  for (scene.first_scan = 0; scene.first_scan + scene.scans <= scene.scenario_scans;
       ++scene.first_scan) {
    const nda::Problem window = nda::generate_tracking(scene).problem;
    const nda::Solution solution = nda::solve(window, {}, last);
    std::printf("scans %2d to %2d: %3zu tracks, cost %.3f%s\n",
                scene.first_scan + 1,
                scene.first_scan + scene.scans,
                solution.solutions.front().arcs.size(),
                solution.cost,
                solution.proven ? "" : ", not proven");
    last = nda::warm_start(solution);
    last.shift(1);
  }
}
