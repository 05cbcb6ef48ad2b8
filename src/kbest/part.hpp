#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bnb/component_slack.hpp"
#include "bnb/slack_search.hpp"
#include "core/clock.hpp"
#include "core/component.hpp"
#include "kbest/combinations.hpp"
#include "kbest/nearby_packings.hpp"
#include "kbest/packing_buffer.hpp"
#include "kbest/slack_view.hpp"

namespace nda::kbest {

/// Work of searches (bnb::SlackLimits) before another way is tried.  It decides what is tried, not
/// what is true.
struct PartPatience {
  double trial = 1;     ///< times the usual for a search by the multipliers at hand
  double search = 4e6;  ///< for the first search that is no trial
  double search_per_arc = 1e3;
  double nearby = 4e6;     ///< of searches after which looking nearby pays
  double cliques = 0.25;   ///< times that, for covers by cliques; 0 = none
  int turns = 1;           ///< of all these, before branch and cut has one
  double leaf_work = 4e6;  ///< of searches that may end its nodes
};

/// A part of a problem that shares no index with the rest, with the slack of its arcs and indices,
/// what the best solution has of it, and its packings as far as they were ranked.
class Part {
 public:
  /// @param component  cut out of the problem of `view`, which has the prices.
  /// @param grid       spacing of the costs (core::CostGrid), 0 if there is none.
  Part(core::Component component,
       const SlackView& view,
       double grid,
       const PartPatience& patience = {});

  /// Of the problem, ascending.
  std::span<const core::ArcId> arcs() const { return component_.arc_origin; }
  /// Ranks the packings that cost no more than `reach` above the best solution's, or the k best of
  /// them; nothing is searched where it is known that there are no others.  Returns whether the
  /// limits let it; `nodes` grows by those searched.
  bool rank(double reach,
            std::size_t k,
            const bnb::SlackLimits& limits,
            Combinations& combinations,
            std::int64_t& nodes);

  /// The packings found, by what they cost more than the best solution's, ascending: all those
  /// within the last reach, or the k best of them, and maybe others.
  const RankedList& list() const { return list_; }
  /// None that is not listed costs less than this above the best solution's.
  double reached() const { return reached_; }

 private:
  // One way to write costs as slack.
  struct Form {
    bnb::ComponentSlack slack{bnb::SlackProblem(0), {}};
    double reach = kInfinity;  // packings of other arcs cost more above the best
    double least = 0;          // slack of the best solution
    double error = 0;          // of rounding
  };
  struct Found {
    RankedList list;
    double reached;
    bool complete;
    std::int64_t nodes;
    double work;
  };

  struct Run;  // a call of rank()

  void finish(Form& form) const;
  bool is_ranked(double reach, std::size_t k) const;
  const Form& form(double reach) const;
  void tighten(double reach, int max_rounds, const core::Deadline& deadline);
  bool take(Run& run, Found found, double within);
  void look_nearby(Run& run, NearbyPackings& nearby);
  void begin(const Run& run);
  void know(std::vector<core::ArcId> arcs);
  void know_all(const RankedList& list, const Run& run);
  double settled() const;
  void settle(Run& run);
  Ranked listed(const PackingBuffer::Kept& packing, Combinations& combinations) const;
  double most_within(const Run& run) const;
  double next_within(const Run& run) const;
  Found rank_slacks(const Run& run, const Form& form, double reach, double max_work) const;
  Found rank_by_branching(const Run& run, double reach, double max_work);
  Found rank_by_cliques(const Run& run, double reach, double max_work) const;
  template <typename Rank>
  Found search(const Form& form, double reach, std::size_t k, Rank&& rank) const;

  double margin(double error) const;
  double on_grid(double rise) const;
  double reached_within(const Form& form, double budget) const;
  double useful(double within, double most) const;

  core::Component component_;
  double grid_;
  PartPatience patience_;
  std::vector<core::ArcId> best_;       // arcs of the best solution
  double largest_ = 0;                  // cost or multiplier, in size
  Form first_;                          // by the multipliers of the best solution
  std::optional<Form> tight_;           // where that led to long searches
  int tight_rounds_ = 0;                // of cuts that it was allowed
  std::optional<PackingBuffer> known_;  // of first_: packings, whether listed or not
  RankedList list_;
  std::size_t listed_k_ = 0;  // of how many the list is
  double reached_ = 0;
};

/// What lies above that is beyond a slack, whatever rounding did.
double beyond(double slack, double error);

}  // namespace nda::kbest
