#include "assign2d/exchange_draft.hpp"

#include <algorithm>
#include <cmath>

// An assignment's graph is drawn from its parent's: duals move by min(distance, length) of the
// search that found the cycle, which leaves all losses not negative and those on the cycle zero, so
// that the arcs of the cycle can be turned round.
//
// Then it is cut down.  The duals of an optimal assignment are far from unique, and those that
// shortest paths leave make a tree of exchanges free of charge, most of which are in no cheap
// cycle. So duals are balanced first (as a matrix is, Osborne 1960, here for the least instead of
// the sum): each member's shift makes the cheapest way in as dear as the cheapest way out.  All at
// once by half the difference never makes a loss negative: an arc loses at most half the least that
// leaves its tail and half the least that enters its head, and it is no cheaper than either.

namespace nda::lap {

void ExchangeDraft::resize(std::uint32_t num_rows) {
  leaving_.resize(num_rows + 1);
  entering_.resize(num_rows + 1);
  shift_.resize(num_rows + 1);
  is_out_.resize(num_rows + 1);
  taker_.resize(num_rows + 1);
  former_.resize(num_rows + 1);
  gets_.resize(num_rows + 1);
  ways_in_.resize(num_rows + 1);
  ways_out_.resize(num_rows + 1);
  place_.resize(num_rows + 1);
}

void ExchangeDraft::add(double loss, std::uint32_t pair, std::uint32_t target, double spare) {
  if (loss > spare) {
    beyond_ = std::min(beyond_, loss);
  } else {
    exchanges_.push_back({loss, pair, target});
  }
}

void ExchangeDraft::draw_best(const Assign2dProblem& problem, const PairPool& pool, double spare) {
  const Assign2dResult& best = pool.best();
  const std::uint32_t num_rows = problem.num_rows();
  members_.assign(num_rows, {});
  exchanges_.clear();
  beyond_ = pool.next_reach(spare);
  for (std::uint32_t i = 0; i < num_rows; ++i) {
    const std::int32_t has = best.column_of_row[i];
    Member& member = members_[i];
    member = {0, i, kNone, static_cast<std::uint32_t>(exchanges_.size()), 0, false};
    for (std::uint32_t k = pool.begin(i); k < pool.begin(i + 1); ++k) {
      const std::int32_t j = static_cast<std::int32_t>(pool.column(k));
      if (j == has) {
        member.held = k;
        continue;
      }
      const std::int32_t mate = best.row_of_column[j];
      const std::uint32_t target =
          mate == kUnassigned ? num_rows : static_cast<std::uint32_t>(mate);
      if (pool.reduced_cost(k) <= spare) exchanges_.push_back({pool.reduced_cost(k), k, target});
    }
    if (has != kUnassigned) {
      member.drop = std::max(0.0, problem.column_outside[has] - best.v[has]);
      add(std::max(0.0, problem.row_outside[i] - best.u[i]), kNone, num_rows, spare);
    }
    member.end = static_cast<std::uint32_t>(exchanges_.size());
  }
}

// Who has what after the cycle.
void ExchangeDraft::follow_cycle(const ExchangeGraph& graph,
                                 std::uint32_t source,
                                 const CycleSearch& search,
                                 const PairPool& pool) {
  const std::uint32_t outside = graph.outside();
  for (std::uint32_t n = source; n < outside; ++n) {
    taker_[n] = n;
    former_[n] = n;
    gets_[n] = graph.members[n].held;
  }
  free_column_ = kNone;
  for (std::uint32_t to = source, from = kNone; from != source; to = from) {
    from = search.before(to);
    if (from == outside) {
      taker_[to] = outside;
      continue;
    }
    gets_[from] = search.exchange_to(to)->pair;
    former_[from] = to;
    if (to != outside) {
      taker_[to] = from;
    } else if (gets_[from] != kNone) {
      free_column_ = pool.column(gets_[from]);
      free_taker_ = from;
    }
  }
}

void ExchangeDraft::draw_member(const ExchangeGraph& graph,
                                std::uint32_t source,
                                std::uint32_t member,
                                const CycleSearch& search,
                                const PairPool& pool,
                                double spare) {
  const std::uint32_t outside = graph.outside();
  const Member& old = graph.members[member];
  const double moved = member == source ? 0 : search.potential(member);
  const double outside_moved = search.potential(outside);
  Member drawn{0, old.row, gets_[member], static_cast<std::uint32_t>(exchanges_.size()), 0, false};
  if (drawn.held != kNone && former_[member] != outside) {
    const std::uint32_t former = former_[member];
    drawn.drop =
        std::max(0.0, graph.members[former].drop + outside_moved - search.potential(former));
  }
  for (const Exchange& exchange : graph.of(member)) {
    if (exchange.target < source || exchange.pair == drawn.held) continue;
    std::uint32_t target = taker_[exchange.target];
    if (exchange.target == outside) {
      const bool is_taken = free_column_ != kNone && exchange.pair != kNone &&
                            pool.column(exchange.pair) == free_column_;
      target = is_taken ? free_taker_ : outside;
    }
    const double loss = exchange.loss + moved - search.potential(exchange.target);
    add(std::max(0.0, loss), exchange.pair, target - source, spare);
  }
  if (drawn.held != old.held && member != source) {
    const std::uint32_t target = old.held == kNone ? outside : taker_[member];
    exchanges_.push_back({0, old.held, target - source});
  }
  drawn.end = static_cast<std::uint32_t>(exchanges_.size());
  members_.push_back(drawn);
}

void ExchangeDraft::draw_next(const ExchangeGraph& graph,
                              std::uint32_t source,
                              const CycleSearch& search,
                              const PairPool& pool,
                              double spare) {
  follow_cycle(graph, source, search, pool);
  members_.clear();
  exchanges_.clear();
  beyond_ = kInfinity;
  for (std::uint32_t n = source; n < graph.outside(); ++n) {
    draw_member(graph, source, n, search, pool, spare);
  }
}

void ExchangeDraft::measure() {
  for (std::uint32_t n = 0; n < outside(); ++n) {
    leaving_[n] = kInfinity;
    entering_[n] = members_[n].drop;
  }
  entering_[outside()] = 0;
  leaving_[outside()] = 0;
  for (std::uint32_t n = 0; n < outside(); ++n) {
    double least = kInfinity;
    for (std::uint32_t k = members_[n].begin; k < members_[n].end; ++k) {
      const Exchange& exchange = exchanges_[k];
      least = exchange.loss < least ? exchange.loss : least;
      double& entering = entering_[exchange.target];
      entering = exchange.loss < entering ? exchange.loss : entering;
    }
    leaving_[n] = least;
  }
}

// Takes out members, and exchanges in no cycle shorter than `spare`: whoever gives something up
// leaves too.
void ExchangeDraft::cut(double spare) {
  is_out_[outside()] = 0;
  for (std::uint32_t n = 0; n < outside(); ++n) {
    const double loss = leaving_[n] + entering_[n];
    is_out_[n] = loss > spare || loss == kInfinity;
    if (is_out_[n]) beyond_ = std::min(beyond_, loss);
    const double drop = members_[n].drop + leaving_[n];
    if (!is_out_[n] && drop > spare) {
      beyond_ = std::min(beyond_, drop);
      members_[n].drop = kInfinity;
    }
  }
  std::uint32_t kept = 0;
  for (std::uint32_t n = 0; n < outside(); ++n) {
    const std::uint32_t begin = kept;
    for (std::uint32_t k = members_[n].begin; k < members_[n].end && !is_out_[n]; ++k) {
      const Exchange& exchange = exchanges_[k];
      if (is_out_[exchange.target]) continue;
      const double loss = exchange.loss + std::max(leaving_[exchange.target], entering_[n]);
      if (loss > spare || loss == kInfinity) {
        beyond_ = std::min(beyond_, loss);
      } else {
        exchanges_[kept++] = exchange;
      }
    }
    members_[n].begin = begin;
    members_[n].end = kept;
  }
  exchanges_.resize(kept);
}

void ExchangeDraft::shift() {
  shift_[outside()] = 0;
  for (std::uint32_t n = 0; n < outside(); ++n) {
    const bool is_fixed = is_out_[n] || members_[n].held == kNone;
    shift_[n] = is_fixed ? 0 : (leaving_[n] - entering_[n]) / 2;
    members_[n].drop = std::max(0.0, members_[n].drop + shift_[n]);
  }
  for (std::uint32_t n = 0; n < outside(); ++n) {
    for (std::uint32_t k = members_[n].begin; k < members_[n].end; ++k) {
      Exchange& exchange = exchanges_[k];
      exchange.loss = std::max(0.0, exchange.loss - shift_[n] + shift_[exchange.target]);
    }
  }
}

void ExchangeDraft::tune(int rounds, double spare) {
  measure();
  for (int n = 0; n < rounds; ++n) {
    cut(spare);
    if (n + 1 < rounds) shift();
    measure();
  }
}

// For each member, where exchanges to it come from, and how many ways in and out it has.
void ExchangeDraft::count_ways() {
  const std::uint32_t num_nodes = outside() + 1;
  source_start_.assign(num_nodes + 2, 0);
  sources_.resize(exchanges_.size());
  for (std::uint32_t n = 0; n < outside(); ++n) {
    ways_out_[n] = 0;
    for (std::uint32_t k = members_[n].begin; k < members_[n].end; ++k) {
      if (is_out_[exchanges_[k].target]) continue;
      ++ways_out_[n];
      ++source_start_[exchanges_[k].target + 2];
    }
  }
  for (std::uint32_t n = 0; n < num_nodes; ++n) source_start_[n + 2] += source_start_[n + 1];
  for (std::uint32_t n = 0; n < outside(); ++n) {
    for (std::uint32_t k = members_[n].begin; k < members_[n].end; ++k) {
      if (!is_out_[exchanges_[k].target]) sources_[source_start_[exchanges_[k].target + 1]++] = n;
    }
  }
  for (std::uint32_t n = 0; n < outside(); ++n) {
    ways_in_[n] = source_start_[n + 1] - source_start_[n] + (members_[n].drop < kInfinity ? 1 : 0);
  }
}

// Takes out a member, then all that have no way in or no way out any more; adds them to the order.
void ExchangeDraft::take_out(std::uint32_t member) {
  std::size_t next = order_.size();
  const auto add = [&](std::uint32_t n) {
    is_out_[n] = 1;
    order_.push_back(n);
  };
  for (add(member); next < order_.size(); ++next) {
    const std::uint32_t n = order_[next];
    for (std::uint32_t k = members_[n].begin; k < members_[n].end; ++k) {
      const std::uint32_t target = exchanges_[k].target;
      if (!is_out_[target] && target != outside() && --ways_in_[target] == 0) add(target);
    }
    for (std::uint32_t k = source_start_[n]; k < source_start_[n + 1]; ++k) {
      if (!is_out_[sources_[k]] && --ways_out_[sources_[k]] == 0) add(sources_[k]);
    }
  }
}

// Members by descending loss, so that the promising branches are small, the first one drawn in
// front if so wished.
void ExchangeDraft::list_candidates(bool keep_first) {
  candidates_.clear();
  for (std::uint32_t n = 0; n < outside(); ++n) {
    if (!is_out_[n]) candidates_.push_back(n);
  }
  const bool has_first = keep_first && !candidates_.empty() && candidates_[0] == 0;
  std::sort(
      candidates_.begin() + has_first, candidates_.end(), [&](std::uint32_t a, std::uint32_t b) {
        const double loss_a = leaving_[a] + entering_[a], loss_b = leaving_[b] + entering_[b];
        return loss_a != loss_b ? loss_a > loss_b : a < b;
      });
}

// Once a member keeps what it has, many others are in no cycle any more.  They follow it, so that
// later branches are without them, and have no branch themselves.
void ExchangeDraft::sort_members(bool keep_first) {
  list_candidates(keep_first);
  count_ways();
  order_.clear();
  for (const std::uint32_t n : candidates_) {
    if (!is_out_[n] && (ways_in_[n] == 0 || ways_out_[n] == 0)) take_out(n);
  }
  order_.clear();
  for (const std::uint32_t n : candidates_) {
    if (is_out_[n]) continue;
    members_[n].is_branch = true;
    take_out(n);
  }
}

void ExchangeDraft::store(bool keep_first, ExchangeStore& store) {
  sort_members(keep_first);
  std::fill_n(place_.begin(), outside(), kNone);
  for (std::uint32_t n = 0; n < order_.size(); ++n) place_[order_[n]] = n;
  place_[outside()] = static_cast<std::uint32_t>(order_.size());
  for (const std::uint32_t n : order_) {
    Member member = members_[n];
    member.begin = static_cast<std::uint32_t>(store.exchanges.size());
    for (std::uint32_t k = members_[n].begin; k < members_[n].end; ++k) {
      const Exchange& exchange = exchanges_[k];
      const std::uint32_t target = place_[exchange.target];
      if (target != kNone) store.exchanges.push_back({exchange.loss, exchange.pair, target});
    }
    member.end = static_cast<std::uint32_t>(store.exchanges.size());
    store.members.push_back(member);
  }
}

}  // namespace nda::lap
