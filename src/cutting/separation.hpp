#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "core/lists.hpp"
#include "core/random.hpp"
#include "cutting/cut.hpp"

namespace nda::cutting {

/// Of so many rows separation soon has looked at all sets that may give a cut.
inline constexpr std::size_t kFewRows = 128;

/// A cut and by how much a point violates it.
struct ViolatedCut {
  Cut cut;
  double violation;
};

/// Keeps so many of them, the most violated first.
void keep_most_violated(std::vector<ViolatedCut>& cuts, std::size_t most);

/// Weights of a cut before rows are chosen for them: descending, below the divisor.
struct Pattern {
  std::vector<std::uint8_t> weights;
  std::uint8_t divisor;
};

/// The patterns that closed most of the gap on tracking problems, in the order of their use.
std::span<const Pattern> patterns();

/// How hard to look for cuts.
struct SeparationEffort {
  double least_violation;
  std::size_t patience;  ///< fruitless starts that end the search of a pattern, as a multiple
  std::size_t starts;    ///< from every row
};

/// Separates fractional points of one component: which cuts do they violate?  Sees only the arcs
/// 0 < x < 1; the others can violate nothing.
class Separator {
 public:
  /// x[k] is the value of arc arcs[k].
  Separator(const core::Component& component,
            std::span<const core::ArcId> arcs,
            std::span<const double> x);

  /// No arc is fractional.
  bool integral() const { return value_.empty(); }
  std::size_t num_rows() const { return slot_of_row_.size(); }
  /// Arcs times their rows that search() looked at so far.
  double work() const { return work_; }

  /// All cuts over three indices violated by more than `least`, found by enumerating the triangles
  /// of rows that share fractional arcs.  Stops at the deadline.
  std::vector<ViolatedCut> three_rows(double least, const core::Deadline& deadline) const;

  /// Violated cuts of a pattern: from every row a local search over which row takes which weight.
  /// Heuristic, and random: another seed, other cuts.  Stops at the deadline.
  std::vector<ViolatedCut> search(const Pattern& pattern,
                                  const SeparationEffort& effort,
                                  std::uint64_t seed,
                                  const core::Deadline& deadline);

 private:
  struct Neighbour {
    std::uint32_t row;
    double weight;  // sum of x over the arcs that use both rows
  };

  std::span<const std::uint32_t> rows_of(std::uint32_t arc) const {
    return std::span(arc_rows_).subspan(arc_start_[arc], arc_start_[arc + 1] - arc_start_[arc]);
  }
  std::span<const std::uint32_t> arcs_of(std::uint32_t row) const { return row_arcs_[row]; }
  std::vector<std::vector<Neighbour>> later_neighbours() const;
  double all_three(std::uint32_t r, std::uint32_t s, std::uint32_t t) const;
  void prepare(const Pattern& pattern);
  void place(const Pattern& pattern, std::size_t position, std::uint32_t row);
  std::uint32_t best_row(std::size_t position, std::uint32_t held, double noise);
  bool climb(const Pattern& pattern, std::uint32_t seed, double noise);
  double violation(const Pattern& pattern);
  Cut cut_of(std::span<const std::uint32_t> rows, const Pattern& pattern) const;

  // The fractional part of the point, rows and arcs numbered from 0.
  std::vector<double> value_;
  std::vector<std::uint32_t> arc_start_ = {0};
  std::vector<std::uint32_t> arc_rows_;
  core::Lists<std::uint32_t> row_arcs_;
  std::vector<std::uint32_t> slot_of_row_;

  // The local search: which row holds which position, and the weights that gives the arcs.
  std::vector<std::uint32_t> chosen_;      // [position]
  std::vector<char> taken_;                // [row]
  std::vector<int> arc_weight_;            // [arc]
  std::vector<std::vector<double>> gain_;  // [position][weight of an arc]
  std::uint32_t stamp_ = 0;
  std::vector<std::uint32_t> seen_;  // [arc]
  std::vector<double> score_;        // [row], 0 between steps
  std::vector<std::uint32_t> scored_;
  double work_ = 0;
  core::Random random_{1};
};

}  // namespace nda::cutting
