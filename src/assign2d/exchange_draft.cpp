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
    member = {0, i, kNone, static_cast<std::uint32_t>(exchanges_.size()), 0};
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
  Member drawn{0, old.row, gets_[member], static_cast<std::uint32_t>(exchanges_.size()), 0};
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

void ExchangeDraft::store(bool keep_first, ExchangeStore& store) {
  order_.clear();
  for (std::uint32_t n = 0; n < outside(); ++n) {
    if (!is_out_[n]) order_.push_back(n);
  }
  const bool has_first = keep_first && !order_.empty() && order_[0] == 0;
  std::sort(order_.begin() + has_first, order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double loss_a = leaving_[a] + entering_[a], loss_b = leaving_[b] + entering_[b];
    return loss_a != loss_b ? loss_a > loss_b : a < b;
  });
  for (std::uint32_t n = 0; n < order_.size(); ++n) place_[order_[n]] = n;
  place_[outside()] = static_cast<std::uint32_t>(order_.size());
  for (const std::uint32_t n : order_) {
    Member member = members_[n];
    member.begin = static_cast<std::uint32_t>(store.exchanges.size());
    for (std::uint32_t k = members_[n].begin; k < members_[n].end; ++k) {
      const Exchange& exchange = exchanges_[k];
      if (is_out_[exchange.target]) continue;
      store.exchanges.push_back({exchange.loss, exchange.pair, place_[exchange.target]});
    }
    member.end = static_cast<std::uint32_t>(store.exchanges.size());
    store.members.push_back(member);
  }
}

}  // namespace nda::lap
