#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "nda/assign2d.hpp"
#include "nda/types.hpp"

namespace nda {

/// How the dual function is maximised.
enum class DualMethod { kBundleTrust, kSubgradient, kVolume, kCoordinate };

/// How a relaxed solution is made feasible.
enum class RecoveryMethod {
  kRecursive,    ///< the report's recursion down to two dimensions
  kDualGreedy,   ///< greedy by reduced cost: cheaper, not as good
  kLocalSearch,  ///< the recursion, then descent by local search
};

/// Which of the index alignments that nonsmooth optimisation passes is recovered from.
enum class AlignmentRule {
  kBestValue,       ///< that of the best multipliers
  kLeastViolation,  ///< that of the shortest subgradient; of several, the best multipliers
};

/// Which sets a relaxation keeps: the first in this order (docs/relaxations.md).
enum class SetOrder {
  kAsGiven,
  kLargestFirst,          ///< by the number of indices: the fewest multipliers
  kMostConflictingFirst,  ///< by how many pairs of arcs share an index of the set
  kProbe,                 ///< the choice of best bound after a few evaluations
};

/// How a component is solved.
enum class Method {
  kAuto,        ///< small ones exactly, large ones by relaxation, fixing and branching
  kRelaxation,  ///< the report's algorithm alone: relaxation and recovery, nothing else
  kExact,       ///< branch and bound from the start
};

/// Which reductions try to settle a component before anything else does (docs/reductions.md).
enum class Reductions {
  kNone,
  kQuick,  ///< those that save more than they cost
  kAll,    ///< and dominated arcs, and parts that hang on one index
};

/// Lagrangian relaxation (report, sections 3 and 4; docs/relaxations.md).
struct RelaxationOptions {
  /// m, the sets that are kept, of N never more than N - 1; in [0, 64].  Of two dimensions both are
  /// kept, whatever m is: the relaxed problem is the problem.  With three and more the
  /// relaxed problems are assignment problems of m dimensions, relaxed to min(kept_sets, m - 1).
  /// Recovery problems keep two.
  int kept_sets = 2;
  /// Relaxed problems of three and more dimensions: solved exactly up to so many arcs, with at most
  /// so many nodes (>= 0) each time; else by so many evaluations (>= 1) from the last multipliers.
  std::size_t kept_exact_arcs = 2000;
  std::int64_t kept_nodes = 100000;
  int kept_evaluations = 20;
  /// With three and more kept sets: maximise the dual function of two first, and begin at its
  /// multipliers, where theirs is at least as large (4.2b).
  bool two_first = true;
  /// Guide the nonsmooth steps by what relaxed problems not solved exactly are proven to cost, the
  /// merit function (4.5), and not by what their best known packing costs.
  bool merit = true;
  /// Split problems, relaxed problems and recovery problems into connected components (4.7).
  bool decompose = true;
  SetOrder set_order = SetOrder::kAsGiven;       ///< of a component: its first sets are kept
  SetOrder recovery_order = SetOrder::kAsGiven;  ///< the same of recovery problems
  DualMethod dual_method = DualMethod::kBundleTrust;
  Assign2dMethod assign2d = Assign2dMethod::kShortestPath;  ///< evaluates the dual function
  RecoveryMethod recovery = RecoveryMethod::kRecursive;
  /// Of the dual function of each large component; >= 1.  At most max(50, indices / 25) where a
  /// linear program follows (Method::kAuto), with bounds on uses 30.
  int max_evaluations = 300;
  int recovery_evaluations = 20;  ///< of each lower-dimensional recovery problem; >= 1
  /// Recover at every so many evaluations, at every one in three dimensions, and at the best; >= 1.
  /// Method::kAuto: at the best only where a linear program follows, else at every 100 or more.
  int recovery_interval = 10;
  double relative_tolerance = 1e-7;  ///< stop when the predicted increase falls below; >= 0
  AlignmentRule alignment = AlignmentRule::kBestValue;
  /// Maximise the dual of the inner problem (docs/partial_branch_and_bound.md) before that of the
  /// recovery problem, with so many evaluations; 0 = leave it out.
  int inner_evaluations = 0;
};

/// Search for good solutions besides the recovery.
struct SearchOptions {
  Reductions reductions = Reductions::kQuick;
  bool local_search = true;  ///< local search and neighbourhood search where bounds do not end it
  /// With it: the dimensionwise move, where a good part of all tuples are arcs (docs/pipeline.md).
  bool dimensionwise = true;
  int kicks_per_index = 2;  ///< of local search: random moves per index of the component; >= 0
};

/// How solve_k_best() finds the solutions after the first (docs/k_best.md).
enum class RankingMethod {
  kExact,       ///< all within reach: every rank proven
  kAlignments,  ///< partial branch and bound over index alignments: good ones, without proof
  kMurty,       ///< the same over the best two-dimensional assignments of the best multipliers
};

/// The k best.
struct RankingOptions {
  RankingMethod method = RankingMethod::kExact;
  /// Of partial branch and bound: alignments followed at each stage; in [1, 10000].
  int branches = 4;
  /// Of partial branch and bound: improve what it finds in a component by local search, with
  /// search.kicks_per_index, and list both; ten times the time, worth it where steps are few.
  bool local_search = false;
};

/// Branch and bound.
struct BranchOptions {
  std::size_t exact_arcs =
      128;  ///< components of at most so many arcs are enumerated (docs/report.md), up to
            ///< twice as many covered by cliques (docs/cuts.md)
  std::int64_t max_nodes = std::numeric_limits<std::int64_t>::max();  ///< per component; >= 0
  int node_evaluations = 60;  ///< of the dual function at a node; >= 1
  /// Components with so many indices left get cuts over three indices as rows of the Lagrangian
  /// dual before any linear program, which takes long there; those whose linear program would be
  /// too large always do (docs/cuts.md).
  std::size_t averaged_cuts_indices = 30000;
};

/// What a progress callback sees; sums over all components.
struct Progress {
  double seconds = 0;       ///< since the solve began
  double cost = kInfinity;  ///< of the best known solution; +inf until there is one
  double lower_bound = -kInfinity;
  std::size_t components_done = 0;  ///< proven, optimal or infeasible
  std::size_t num_components = 0;   ///< 0 until they are known
  const char* event = "";  ///< what found it: "greedy", "recovery", "bound", ...; or "working"
};

/// Everything that can be asked of a solve.  docs/options.md lists names, defaults and ranges.
struct Options {
  Method method = Method::kAuto;
  /// Seconds, > 0.  Obeyed to 5 ms, or 1 %, or 0.1 us for every arc and index of the problem,
  /// whichever is most: so much may the longest stretch between two looks at the clock take, or the
  /// certificate of the bound, which every answer carries (measured: bench/deadline.py).  A limit
  /// too short for anything else gives the singletons and the bound that they prove.  Requests to
  /// stop are met as quickly.
  double time_limit_s = kInfinity;
  double relative_gap = 0;  ///< stop when (cost - bound) / |cost| is at most this; >= 0
  int num_threads = 1;      ///< 0 = all cores; <= 1024; the answer does not depend on it
  std::uint64_t seed = 1;   ///< of the randomised searches
  bool proof = false;       ///< write down a proof: it takes memory, some kilobytes for every node
  RelaxationOptions relaxation;
  SearchOptions search;
  BranchOptions branch;
  RankingOptions ranking;

  /// Called on every improvement, whenever a component is done, and with the event "working" when
  /// there was neither for a second; by a thread that solves, never concurrently.  Return false to
  /// stop; it is not called again then.
  std::function<bool(const Progress&)> progress;
  std::stop_token stop;
};

/// Throws InputError naming the first option out of range; NaN is out of every range.
void validate(const Options& options);

/// A named, complete configuration; presets() lists the names.  Throws InputError for another one.
Options preset(const std::string& name);

/// What preset() knows.
struct PresetInfo {
  const char* name;
  const char* about;  ///< one line
  /// An algorithm as a paper describes it, nothing more: frozen, whatever becomes of the defaults
  /// (docs/presets.md).  Its bound is that of its relaxation, and it proves nothing by search.
  bool is_paper;
};
std::span<const PresetInfo> presets();

}  // namespace nda
