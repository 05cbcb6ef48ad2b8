#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bnb/slack_search.hpp"
#include "core/lists.hpp"
#include "core/random.hpp"
#include "recovery/slack_packing.hpp"

namespace nda::recovery {

/// A few arcs of a packing that are taken out, and the best way to fill the indices they leave.
/// Looks at a packing that others may look at meanwhile; used again and again for the memory it
/// keeps.
class Neighbourhood {
 public:
  /// Keeps references to all of them.
  /// @param arcs  of every index, by reduced cost.
  Neighbourhood(const bnb::SlackProblem& problem,
                const core::Lists<std::uint32_t>& arcs,
                const SlackPacking& packing);

  /// Takes out up to `size` arcs around an index, sometimes for a detour: one of them must not come
  /// back, and the slack may rise by so much.
  void choose(std::uint32_t seed, std::size_t size, double most_rise, core::Random& random);

  /// Searches the best way to fill it again by arcs of reduced cost up to `most_reduced`.
  void search(double most_reduced, const bnb::SlackLimits& limits);

  /// Arcs taken out; fewer than were asked for where no more are near.
  std::size_t size() const { return freed_.size(); }
  /// Nothing better is there.
  bool is_complete() const { return best_.complete; }
  /// Something better was found.
  bool has_found() const { return best_.slack < kInfinity; }
  /// Of the search and what led to it (bnb::SlackLimits).
  double work() const { return work_; }

  /// Puts what was found into the packing, unless that has changed so that it no longer fits or no
  /// longer pays; returns whether it did.
  bool fill(SlackPacking& packing) const;

 private:
  void free_arc(std::uint32_t arc);
  bool fits(std::uint32_t arc) const;
  void list_candidates(double most_reduced);
  void list_rows();
  bnb::SlackProblem subproblem();
  double slack_of_freed() const;
  bool is_current() const;

  const bnb::SlackProblem& problem_;
  const core::Lists<std::uint32_t>& arcs_;
  const SlackPacking& packing_;
  std::vector<std::uint32_t> freed_;  // arcs
  std::vector<std::uint32_t> freed_indices_;
  std::vector<char> is_freed_;             // [index]
  std::uint32_t without_ = 0;              // the arc that must not come back
  double allowed_rise_ = 0;                // of the slack
  std::vector<std::uint32_t> candidates_;  // arcs that fit
  std::vector<std::uint32_t> rows_;        // of the subproblem, indices first
  std::vector<std::uint32_t> row_;         // [row]: its number in the subproblem
  std::vector<std::uint32_t> taken_;       // [row]: what freed arcs use; 0 between searches
  std::vector<char> listed_;               // [arc]; 0 between searches
  bnb::SlackResult best_;                  // arcs are numbers of candidates
  double work_ = 0;
};

}  // namespace nda::recovery
