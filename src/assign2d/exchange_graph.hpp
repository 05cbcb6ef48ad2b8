#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "assign2d/pair_pool.hpp"
#include "assign2d/side.hpp"
#include "nda/assign2d.hpp"

namespace nda::lap {

/// A row takes something else than what it has: the column of another row, a free column, or its
/// outside option.
struct Exchange {
  double loss;           ///< reduced cost, not negative
  std::uint32_t pair;    ///< of the pool, that the row gets; kNone = its outside option
  std::uint32_t target;  ///< the member that has its column; the number of members = outside
};

/// A row that may make exchanges.
struct Member {
  double drop;          ///< reduced cost of leaving its column to nobody; 0 if it has none
  std::uint32_t row;    ///< of the problem
  std::uint32_t held;   ///< pair of the pool; kNone = its outside option
  std::uint32_t begin;  ///< of its exchanges
  std::uint32_t end;
  bool is_branch;  ///< false: in no cycle without the members before it
};

/// All ways from an assignment that is the best of a set to the others of the set.
///
/// Nodes are the members and "outside", which has room for everyone.  Another assignment is one or
/// more cycles: each member of a cycle takes the column of the next one.  An exchange is an arc,
/// and from outside there is an arc of length `drop` to every member.  The cost of the other
/// assignment is that of the best plus the lengths.
struct ExchangeGraph {
  std::span<const Member> members;
  const Exchange* exchanges;  ///< where `begin` and `end` count from

  std::uint32_t outside() const { return static_cast<std::uint32_t>(members.size()); }
  std::size_t num_exchanges() const {
    return members.empty() ? 0 : members.back().end - members.front().begin;
  }
  std::span<const Exchange> of(std::uint32_t member) const {
    return {exchanges + members[member].begin, exchanges + members[member].end};
  }
};

/// Where graphs are kept.
struct ExchangeStore {
  std::vector<Member> members;
  std::vector<Exchange> exchanges;

  void clear() {
    members.clear();
    exchanges.clear();
  }
  ExchangeGraph graph(std::uint32_t begin, std::uint32_t end) const {
    return {std::span(members).subspan(begin, end - begin), exchanges.data()};
  }
};

}  // namespace nda::lap
