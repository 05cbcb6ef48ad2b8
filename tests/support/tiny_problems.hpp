#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nda/problem.hpp"

namespace nda::support {

/// A named instance small enough to be solved by hand, with what the hand found.
///
/// The test beside this file checks every figure: optimum and second best by enumeration; the LP
/// value from both sides, because `dual` proves it a lower bound (sum u + sum of min(0, reduced
/// cost)) and `fraction`, completed by singletons, is a point of the LP that costs no more.
struct TinyProblem {
  std::string name;
  Problem problem;
  std::optional<double> optimum;      ///< nothing = infeasible
  std::optional<double> second_best;  ///< cost of the second solution, ties counted
  std::optional<double> lp_value;  ///< also the best dual value for m <= 2; nothing = LP infeasible
  std::vector<std::vector<double>> dual;  ///< u[k][i-1], optimal for the LP
  std::vector<double> fraction;           ///< x[a], optimal for the LP
};

using Arcs = std::vector<std::pair<std::vector<Index>, double>>;

/// A problem from a list of tuples; singletons given as tuples, the others cost `singleton`.
inline Problem make_problem(std::vector<Index> sizes, const Arcs& arcs, double singleton = 0) {
  ProblemBuilder builder(sizes);
  std::vector<std::vector<bool>> given;
  for (const Index size : sizes) given.emplace_back(size + std::size_t{1}, false);
  for (const auto& arc : arcs) {
    builder.add_arc(arc.first, arc.second);
    std::vector<std::size_t> real;
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      if (arc.first[k] != 0) real.push_back(k);
    }
    if (real.size() == 1) given[real[0]][arc.first[real[0]]] = true;
  }
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    for (Index i = 1; i <= sizes[k]; ++i) {
      std::vector<Index> tuple(sizes.size(), 0);
      tuple[k] = i;
      if (!given[k][i]) builder.add_arc(tuple, singleton);
    }
  }
  return std::move(builder).build();
}

/// 1x1x1, (1,1,1) at -5.  Take it: -5.  Second best: leave it, 0.  LP -5, u = -5 | 0 | 0.
inline TinyProblem one_arc() {
  return {"one_arc", make_problem({1, 1, 1}, {{{1, 1, 1}, -5}}), -5, 0, -5, {{-5}, {0}, {0}}, {1}};
}

/// Nothing to assign: 0x0x0.  Cost 0, the only solution.
inline TinyProblem empty() {
  return {"empty", make_problem({0, 0, 0}, {}), 0, std::nullopt, 0, {{}, {}, {}}, {}};
}

/// 2x1 without arcs, singletons 3, 4 | -1: the only solution costs 6, u = the singletons.
inline TinyProblem no_arcs() {
  return {"no_arcs",
          make_problem({2, 1}, {{{1, 0}, 3}, {{2, 0}, 4}, {{0, 1}, -1}}),
          6,
          std::nullopt,
          6,
          {{3, 4}, {-1}},
          {}};
}

/// 1x1, (1,1) at +1, singletons 0.  Best 0 without the arc; second best 1 with it: an arc that
/// cannot be in the best solution matters for the second.
inline TinyProblem useless_arc() {
  return {"useless_arc", make_problem({1, 1}, {{{1, 1}, 1}}), 0, 1, 0, {{0}, {0}}, {0}};
}

/// Two targets in three scans; only scan 3 is in doubt.
/// (1,1,1) -4, (2,2,2) -4 in parallel: -8.  (1,1,2) -5, (2,2,1) -2 crossing: -7, second best.
/// Greedy starts with -5 and ends at -7.  LP -8, u = -3 -2 | 0 0 | -1 -2 (reduced costs 0, 0, 0,
/// 1).
inline TinyProblem crossing_tracks() {
  return {
      "crossing_tracks",
      make_problem({2, 2, 2}, {{{1, 1, 1}, -4}, {{1, 1, 2}, -5}, {{2, 2, 1}, -2}, {{2, 2, 2}, -4}}),
      -8,
      -7,
      -8,
      {{-3, -2}, {0, 0}, {-1, -2}},
      {1, 0, 0, 1}};
}

/// The smallest integrality gap: 1x1x1, (1,1,0), (0,1,1), (1,0,1) at -1 each, pairwise in conflict
/// on three different indices.  Best -1 (three times, so second best -1 too).  LP -1.5: x = 1/2, u
/// = -1/2.
inline TinyProblem odd_cycle() {
  return {"odd_cycle",
          make_problem({1, 1, 1}, {{{0, 1, 1}, -1}, {{1, 0, 1}, -1}, {{1, 1, 0}, -1}}),
          -1,
          -1,
          -1.5,
          {{-0.5}, {-0.5}, {-0.5}},
          {0.5, 0.5, 0.5}};
}

/// odd_cycle with singletons 1 and arcs 1: shifted costs are again 1 - 2 = -1, the constant is 3.
/// Best 1 + 1 = 2, second 2, LP 3 - 1.5 = 1.5, u = 1/2.
inline TinyProblem priced_odd_cycle() {
  return {"priced_odd_cycle",
          make_problem({1, 1, 1}, {{{0, 1, 1}, 1}, {{1, 0, 1}, 1}, {{1, 1, 0}, 1}}, 1),
          2,
          2,
          1.5,
          {{0.5}, {0.5}, {0.5}},
          {0.5, 0.5, 0.5}};
}

/// Arcs with dummies in both first dimensions: the cell (0,0) of the relaxed 2-D problem is used
/// twice. 1x1x2x2: (0,0,1,1) -2, (0,0,2,2) -3, (1,0,2,1) -1, (1,1,1,2) -4.  Only the first two fit
/// together: -5. Second best -4 (whoever counts (0,0) once believes in it).  LP -5, u = 0 | 0 | -2
/// -1 | 0 -2.
inline TinyProblem zero_zero_cell() {
  return {"zero_zero_cell",
          make_problem(
              {1, 1, 2, 2},
              {{{0, 0, 1, 1}, -2}, {{0, 0, 2, 2}, -3}, {{1, 0, 2, 1}, -1}, {{1, 1, 1, 2}, -4}}),
          -5,
          -4,
          -5,
          {{0}, {0}, {-2, -1}, {0, -2}},
          {1, 1, 0, 0}};
}

/// Every arc is half dummies.  2x2x2x2: (1,1,0,0) -2, (0,1,1,0) -3, (0,0,1,1) -2 form a path of
/// conflicts; (2,0,0,2) -1 and (0,2,2,0) -1 stand alone.  Best: the ends of the path and both
/// others, -6.  Second -5 (the middle instead of the ends, or one of the others left).  LP -6, u =
/// 0 -1 | -2 -1 | -2 0 | 0 0.
inline TinyProblem dummy_chains() {
  return {"dummy_chains",
          make_problem({2, 2, 2, 2},
                       {{{0, 0, 1, 1}, -2},
                        {{0, 1, 1, 0}, -3},
                        {{0, 2, 2, 0}, -1},
                        {{1, 1, 0, 0}, -2},
                        {{2, 0, 0, 2}, -1}}),
          -6,
          -5,
          -6,
          {{0, -1}, {-2, -1}, {-2, 0}, {0, 0}},
          {1, 0, 1, 1, 1}};
}

/// Two components: indices 1 with (1,1,1) -2, (1,1,0) -1; indices 2 with (2,2,2) -3, (0,2,2) -2.5.
/// Best -2 - 3 = -5, second -2 - 2.5 = -4.5.  LP -5, u = -2 0 | 0 -3 | 0 0.
inline TinyProblem two_components() {
  return {"two_components",
          make_problem({2, 2, 2},
                       {{{0, 2, 2}, -2.5}, {{1, 1, 0}, -1}, {{1, 1, 1}, -2}, {{2, 2, 2}, -3}}),
          -5,
          -4.5,
          -5,
          {{-2, 0}, {0, -3}, {0, 0}},
          {0, 0, 1, 1}};
}

/// Plain 2-D assignment, perfect: rows 4 1 3 / 2 0 5 / 3 2 2.  The six permutations cost
/// 6 11 5 9 7 6: best 5, second 6.  LP 5, u = 1 0 1 | 2 0 1.
inline TinyProblem square_2d() {
  return {"square_2d",
          make_problem({3, 3},
                       {{{1, 1}, 4},
                        {{1, 2}, 1},
                        {{1, 3}, 3},
                        {{2, 1}, 2},
                        {{2, 2}, 0},
                        {{2, 3}, 5},
                        {{3, 1}, 3},
                        {{3, 2}, 2},
                        {{3, 3}, 2}},
                       kInfinity),
          5,
          6,
          5,
          {{1, 0, 1}, {2, 0, 1}},
          {0, 1, 0, 1, 0, 0, 0, 0, 1}};
}

/// Perfect 3x3x3, all 27 tuples, c = (i-j)^2 + (j-k)^2 + i + 2j + 3k.  The last three terms sum to
/// 36 in every solution; the squares vanish on the diagonal: best 36.  Exchanging two neighbours of
/// the first or third set adds 1 + 1: second 38.  LP 36, u = i | 2j | 3k.
inline TinyProblem perfect_cube() {
  Arcs arcs;
  std::vector<double> fraction;
  for (Index i = 1; i <= 3; ++i) {
    for (Index j = 1; j <= 3; ++j) {
      for (Index k = 1; k <= 3; ++k) {
        const double ij = static_cast<double>(i) - static_cast<double>(j);
        const double jk = static_cast<double>(j) - static_cast<double>(k);
        arcs.push_back({{i, j, k}, ij * ij + jk * jk + i + 2.0 * j + 3.0 * k});
        fraction.push_back(i == j && j == k ? 1 : 0);
      }
    }
  }
  return {"perfect_cube",
          make_problem({3, 3, 3}, arcs, kInfinity),
          36,
          38,
          36,
          {{1, 2, 3}, {2, 4, 6}, {3, 6, 9}},
          fraction};
}

/// One index that must be covered: 2x2, index 1 of dimension 1 without singleton.  (1,1) 10, (1,2)
/// 12, (2,2) -5.  Best (1,1) + (2,2) = 5, second (1,1) = 10, then 12.  LP 5, u = 10 0 | 0 -5.
inline TinyProblem one_forced_index() {
  return {"one_forced_index",
          make_problem({2, 2}, {{{1, 0}, kInfinity}, {{1, 1}, 10}, {{1, 2}, 12}, {{2, 2}, -5}}),
          5,
          10,
          5,
          {{10, 0}, {0, -5}},
          {1, 0, 1}};
}

/// Infeasible by counting: 2x1, no singletons, (1,1) 1, (2,1) 1; two rows, one column.
inline TinyProblem infeasible_by_counting() {
  return {"infeasible_by_counting",
          make_problem({2, 1}, {{{1, 1}, 1}, {{2, 1}, 1}}, kInfinity),
          std::nullopt,
          std::nullopt,
          std::nullopt,
          {},
          {}};
}

/// Infeasible by Hall's condition though 3x3: rows 1 and 2 know column 1 only.
inline TinyProblem infeasible_by_hall() {
  return {"infeasible_by_hall",
          make_problem(
              {3, 3}, {{{1, 1}, 1}, {{2, 1}, 1}, {{3, 1}, 1}, {{3, 2}, 1}, {{3, 3}, 1}}, kInfinity),
          std::nullopt,
          std::nullopt,
          std::nullopt,
          {},
          {}};
}

/// Infeasible, but neither the LP nor any two dimensions see it: 2x2x2, no singletons, the four
/// tuples of odd parity (1,1,1), (1,2,2), (2,1,2), (2,2,1) at 1 meet pairwise.  LP 2: x = 1/2, u =
/// 1 1 | 0 0 | 0 0.
inline TinyProblem infeasible_by_parity() {
  return {
      "infeasible_by_parity",
      make_problem(
          {2, 2, 2}, {{{1, 1, 1}, 1}, {{1, 2, 2}, 1}, {{2, 1, 2}, 1}, {{2, 2, 1}, 1}}, kInfinity),
      std::nullopt,
      std::nullopt,
      2,
      {{1, 1}, {0, 0}, {0, 0}},
      {0.5, 0.5, 0.5, 0.5}};
}

/// All of the above.
inline std::vector<TinyProblem> all_tiny_problems() {
  std::vector<TinyProblem> all;
  for (const auto& make : {one_arc,
                           empty,
                           no_arcs,
                           useless_arc,
                           crossing_tracks,
                           odd_cycle,
                           priced_odd_cycle,
                           zero_zero_cell,
                           dummy_chains,
                           two_components,
                           square_2d,
                           perfect_cube,
                           one_forced_index,
                           infeasible_by_counting,
                           infeasible_by_hall,
                           infeasible_by_parity}) {
    all.push_back(make());
  }
  return all;
}

}  // namespace nda::support
