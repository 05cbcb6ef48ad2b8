#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/random.hpp"
#include "recovery/gain_packing.hpp"

namespace nda::recovery {

/// Packings by simulated annealing, which then have children: a child keeps what both its parents
/// have, is annealed where they differ, then everywhere at moderate heat, and takes the place of
/// the worse parent if it is no worse.
class AnnealingSearch {
 public:
  /// Keeps a reference.
  explicit AnnealingSearch(const Rivals& rivals) : rivals_(rivals), packing_(rivals) {}

  struct Limits {
    double max_work = 0;  ///< in the units of bnb::SlackLimits; less makes annealing quicker, too
    core::Deadline deadline;
  };

  /// One population from its first packings on until children are no better for long.  Once there
  /// are a few such populations, in earlier runs, their best packings are among the first ones.
  /// Calls found(arcs of the problem, ascending) with those that live at its end, the best of the
  /// population among them.  Returns the work it took, at most `max_work` and one annealing more; 0
  /// where there is nothing to search.  Deterministic for a given state of `random`.
  double run(const Limits& limits,
             core::Random& random,
             const std::function<void(std::vector<std::uint32_t>)>& found);

 private:
  using Members = std::vector<std::uint32_t>;  // ascending

  struct Living {
    Members members;
    double total = 0;
  };

  struct Heat {
    double first = 0;  // of the mean value
    double last = 0;
  };

  bool stopped(const Limits& limits) const;
  Living first_packing(const Limits& limits, core::Random& random);
  Living child(const Living& one, const Living& other, const Limits& limits, core::Random& random);
  bool settle(Living child, Living& parent);
  void remember_best();
  void anneal(std::span<const std::uint32_t> arcs,
              Heat heat,
              double trials_per_arc,
              const Limits& limits,
              core::Random& random);
  void try_arcs(std::span<const std::uint32_t> arcs, double temperature, core::Random& random);
  void force(std::uint32_t n);
  void keep_best();
  Living best() const;

  const Rivals& rivals_;
  GainPacking packing_;
  double mean_value_ = 0;
  double share_ = 1;  // of the trials that there would be if nothing limited work
  std::vector<std::uint32_t> all_;
  std::vector<Living> population_;
  std::vector<Living> ancestors_;  // the best of every population since they last lived again
  // Of the annealing at hand.
  Members best_members_;
  double best_total_ = 0;
  bool gained_ = false;  // since the last loss
  double work_ = 0;
};

}  // namespace nda::recovery
