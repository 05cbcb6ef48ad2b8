#pragma once

#include <cstdint>
#include <vector>

#include "assign2d/cycle_search.hpp"
#include "assign2d/exchange_graph.hpp"
#include "assign2d/pair_pool.hpp"

namespace nda::lap {

/// Makes the graphs of assignments and cuts them down to what is within reach.
class ExchangeDraft {
 public:
  /// For problems of so many rows.
  void resize(std::uint32_t num_rows);

  /// The graph of the best assignment, with all exchanges that lose at most `spare`.
  void draw_best(const Assign2dProblem& problem, const PairPool& pool, double spare);

  /// The graph of the assignment that the cycle found by `search` from member `source` of `graph`
  /// leads to, among those in which the members before keep what they have and that row does not
  /// get back what it had; with all exchanges that lose at most `spare`.
  void draw_next(const ExchangeGraph& graph,
                 std::uint32_t source,
                 const CycleSearch& search,
                 const PairPool& pool,
                 double spare);

  /// So many rounds of: take out what is in no cycle shorter than `spare`, as far as neighbours
  /// show; move duals so that getting into a member costs the same as getting out.
  void tune(int rounds, double spare);

  /// Appends the graph to the store.  Its first member is the first one drawn, if `keep_first` and
  /// it is still there; the other branches follow by descending loss, each with those members that
  /// are in no cycle without it.
  void store(bool keep_first, ExchangeStore& store);

  /// All that has been left out loses at least so much.
  double beyond() const { return beyond_; }
  /// As drawn: of draw_next(), those of its graph from the source on.
  const std::vector<Member>& members() const { return members_; }

 private:
  std::uint32_t outside() const { return static_cast<std::uint32_t>(members_.size()); }
  void add(double loss, std::uint32_t pair, std::uint32_t target, double spare);
  void follow_cycle(const ExchangeGraph& graph,
                    std::uint32_t source,
                    const CycleSearch& search,
                    const PairPool& pool);
  void draw_member(const ExchangeGraph& graph,
                   std::uint32_t source,
                   std::uint32_t member,
                   const CycleSearch& search,
                   const PairPool& pool,
                   double spare);
  void measure();
  void cut(double spare);
  void shift();
  void count_ways();
  void take_out(std::uint32_t member);
  void list_candidates(bool keep_first);
  void sort_members(bool keep_first);

  std::vector<Member> members_;
  std::vector<Exchange> exchanges_;
  double beyond_ = kInfinity;
  std::vector<double> leaving_;   // of each member, then of outside: least loss of its exchanges
  std::vector<double> entering_;  // least loss of the exchanges to it
  std::vector<double> shift_;     // of its dual
  std::vector<std::uint8_t> is_out_;  // taken out, or sorted already

  std::vector<std::uint32_t> taker_;   // who has the column of an old member; old numbers
  std::vector<std::uint32_t> former_;  // whose column a member has; old numbers
  std::vector<std::uint32_t> gets_;    // pair that a member has
  std::uint32_t free_column_ = kNone;  // that the cycle takes from outside
  std::uint32_t free_taker_ = kNone;

  std::vector<std::uint32_t> source_start_;  // of each node in sources_
  std::vector<std::uint32_t> sources_;
  std::vector<std::uint32_t> ways_in_;  // of each member, as long as there are any
  std::vector<std::uint32_t> ways_out_;
  std::vector<std::uint32_t> candidates_;  // to be the next branch
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> place_;  // of each member in it
};

}  // namespace nda::lap
