#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>

#include "mip/external_solver.hpp"
#include "mip/programs.hpp"
#include "nda/solve.hpp"
#include "support/merged_tracks.hpp"

// How long problems with merged measurements take, and CBC takes for them.
//
//   many_to_one_benchmark [SECONDS]
//
// solves one after the other, SECONDS at most for each (30), with nda and with CBC, where that is
// installed, on one thread; prints a line of a table in Markdown for each.  What was not proven in
// time has its gap in place of the seconds.  Exit code 1 where the two prove different costs.

namespace nda {
namespace {

struct Kind {
  const char* name;
  double spacing;
  int scans;
};

constexpr Kind kKinds[] = {{"some merge", 4, 3}, {"many merge", 2.5, 3}, {"five scans", 3.5, 5}};
constexpr int kTracks[] = {30, 100, 300, 1000, 3000};

std::unique_ptr<mip::ExternalSolver> find_cbc() {
  const char* path = std::getenv("PATH");
  const mip::Surroundings surroundings{path == nullptr ? "/usr/bin" : path,
                                       std::filesystem::temp_directory_path().string()};
  for (const mip::ExternalKind& kind : mip::external_kinds()) {
    if (std::string(kind.name) == "cbc") return kind.find(surroundings);
  }
  return nullptr;
}

std::string seconds_or_gap(bool proven, double seconds, double cost, double bound) {
  char text[64];
  const double gap = 100 * (cost - bound) / std::abs(cost);
  if (cost == kInfinity) return "no solution";
  if (proven)
    std::snprintf(text, sizeof text, "%.3f", seconds);
  else
    std::snprintf(text, sizeof text, "gap %.2g %%", gap);
  return text;
}

// Returns false where costs differ that both prove.
bool solve_one(const Kind& kind, int tracks, double limit_s, mip::ExternalSolver* cbc) {
  support::MergedTracksOptions options;
  options.tracks = tracks;
  options.scans = kind.scans;
  options.spacing = kind.spacing;
  const Problem problem = support::MergedTracks(options).make();
  Options limits;
  limits.time_limit_s = limit_s;
  const Solution solution = solve(problem, limits);
  std::size_t largest = 0;
  for (const ComponentReport& part : solution.components)
    largest = std::max(largest, part.num_arcs);
  mip::ExternalAnswer other;
  if (cbc != nullptr) other = cbc->solve(problem, {limit_s, limit_s + 30, {}});
  const bool other_proven = other.status == mip::ExternalStatus::kOptimal;
  std::printf(
      "| %s | %d | %zu | %zu | %zu | %.3f | %lld | %s | %s |\n",
      kind.name,
      tracks,
      problem.num_arcs(),
      solution.num_components,
      largest,
      solution.cost,
      static_cast<long long>(solution.stats.nodes),
      seconds_or_gap(
          solution.proven, solution.stats.solve_seconds, solution.cost, solution.lower_bound)
          .c_str(),
      seconds_or_gap(other_proven, other.seconds, other.cost, other.bound).c_str());
  std::fflush(stdout);
  const bool differ = std::abs(solution.cost - other.cost) > 1e-6 * std::abs(other.cost);
  return !(solution.proven && other_proven && differ);
}

}  // namespace
}  // namespace nda

int main(int argc, char** argv) try {
  const double limit_s = argc > 1 ? std::atof(argv[1]) : 30;
  const auto cbc = nda::find_cbc();
  std::printf(
      "| problem | tracks | arcs | components | largest | cost | nodes | nda, s | CBC, s |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|\n");
  bool agree = true;
  for (const nda::Kind& kind : nda::kKinds) {
    for (const int tracks : nda::kTracks)
      agree = nda::solve_one(kind, tracks, limit_s, cbc.get()) && agree;
  }
  return agree ? 0 : 1;
} catch (const std::exception& fault) {
  std::fprintf(stderr, "%s\n", fault.what());
  return 1;
}
