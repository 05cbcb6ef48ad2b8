#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "nda/io.hpp"
#include "nda/solve.hpp"
#include "support/merged_tracks.hpp"

// How long problems with merged measurements take.
//
//   many_to_one_benchmark [SECONDS] [FOLDER]
//
// solves one after the other, SECONDS at most for each (60), and prints a line for each.  With a
// folder it writes them there, in the format of linear programs, for other solvers.

namespace nda {
namespace {

struct Kind {
  const char* name;
  double spacing;
  int scans;
};

constexpr Kind kKinds[] = {{"some merge", 4, 3}, {"many merge", 2.5, 3}, {"five scans", 3.5, 5}};
constexpr int kTracks[] = {30, 100, 300, 1000, 3000};

void solve_one(const Kind& kind, int tracks, double limit_s, const std::string& folder) {
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
  std::printf("%-12s %6d %8zu %6zu %8zu %-12s %12.3f %12.3f %8lld %8.3f\n",
              kind.name,
              tracks,
              problem.num_arcs(),
              solution.num_components,
              largest,
              to_string(solution.status),
              solution.cost,
              solution.lower_bound,
              static_cast<long long>(solution.stats.nodes),
              solution.stats.solve_seconds);
  std::fflush(stdout);
  if (!folder.empty()) {
    const std::string name = std::string(kind.name).substr(0, 4) + "-" + std::to_string(tracks);
    write_problem(problem, folder + "/" + name + ".lp");
  }
}

}  // namespace
}  // namespace nda

int main(int argc, char** argv) try {
  const double limit_s = argc > 1 ? std::atof(argv[1]) : 60;
  const std::string folder = argc > 2 ? argv[2] : "";
  std::printf("%-12s %6s %8s %6s %8s %-12s %12s %12s %8s %8s\n",
              "kind",
              "tracks",
              "arcs",
              "parts",
              "largest",
              "status",
              "cost",
              "bound",
              "nodes",
              "seconds");
  for (const nda::Kind& kind : nda::kKinds) {
    for (const int tracks : nda::kTracks) nda::solve_one(kind, tracks, limit_s, folder);
  }
} catch (const std::exception& fault) {
  std::fprintf(stderr, "%s\n", fault.what());
  return 1;
}
