#include "kbest/sums.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

// Lists are sorted by what the second packing has more than the first.  A choice is known by the
// last list that does not give its first packing, its position there, and what earlier lists give.
// Three choices follow from it, none of them less: the next position there; the second of the next
// list besides; and, from a second position, the second of the next list instead.  Every choice but
// the first follows from exactly one other.
//
// Source: the frontier of Lawler (1972) for many lists, with the order of lists that makes it
// independent of their number (known from sums of small sets).

namespace nda::kbest {

bool Sums::Choice::operator>(const Choice& other) const {
  return std::tie(slack, list, position) > std::tie(other.slack, other.list, other.position);
}

Sums::Sums(std::vector<const RankedList*> lists, Combinations& combinations)
    : lists_(std::move(lists)), combinations_(combinations) {
  Ranked single;
  std::erase_if(lists_, [&](const RankedList* list) {
    if (list->size() == 1) single = join(single, list->front());
    return list->size() == 1;
  });
  const auto rise = [](const RankedList* list) { return (*list)[1].slack - (*list)[0].slack; };
  std::stable_sort(lists_.begin(), lists_.end(), [&](const RankedList* a, const RankedList* b) {
    return rise(a) < rise(b);
  });
  rest_.assign(lists_.size() + 1, single);
  for (std::size_t n = lists_.size(); n-- > 0;) rest_[n] = join(rest_[n + 1], packing(n, 0));
}

std::optional<Ranked> Sums::next() {
  if (!has_begun_) {
    has_begun_ = true;
    enter(0, 1, {});
    return rest_[0];
  }
  if (open_.empty()) return std::nullopt;
  const Choice least = open_.top();
  open_.pop();
  enter_successors(least);
  const Ranked chosen = join(least.packings, packing(least.list, least.position));
  return Ranked{least.slack, combinations_.join(chosen.arcs, rest_[least.list + 1].arcs)};
}

void Sums::enter_successors(const Choice& choice) {
  const std::size_t next = choice.list + 1;
  enter(choice.list, choice.position + 1, choice.packings);
  if (next == lists_.size()) return;
  enter(next, 1, join(choice.packings, packing(choice.list, choice.position)));
  if (choice.position == 1) enter(next, 1, join(choice.packings, packing(choice.list, 0)));
}

void Sums::enter(std::size_t list, std::size_t position, const Ranked& packings) {
  if (list == lists_.size() || position == lists_[list]->size()) return;
  const double slack = packings.slack + packing(list, position).slack + rest_[list + 1].slack;
  open_.push({slack, list, position, packings});
}

Ranked Sums::join(const Ranked& a, const Ranked& b) {
  return {a.slack + b.slack, combinations_.join(a.arcs, b.arcs)};
}

}  // namespace nda::kbest
