#include "kbest/combinations.hpp"

#include <algorithm>
#include <queue>
#include <utility>

namespace nda::kbest {
namespace {

constexpr std::size_t kSumsBetweenLooks = 4096;

}  // namespace

std::vector<std::uint32_t> Combinations::arcs(Combination combination) const {
  std::vector<std::uint32_t> found;
  std::vector<Combination> open;
  if (combination != kNothing) open.push_back(combination);
  while (!open.empty()) {
    const Pair pair = pairs_[open.back()];
    open.pop_back();
    if (pair.second == kLeaf) {
      found.push_back(pair.first);
    } else {
      open.push_back(pair.first);
      open.push_back(pair.second);
    }
  }
  return found;
}

void merge_ranked(RankedList& list, const RankedList& more, std::size_t k) {
  const auto middle = static_cast<std::ptrdiff_t>(list.size());
  list.insert(list.end(), more.begin(), more.end());
  std::inplace_merge(
      list.begin(), list.begin() + middle, list.end(), [](const Ranked& a, const Ranked& b) {
        return a.slack < b.slack;
      });
  if (list.size() > k) list.resize(k);
}

// The least sum of row i comes from its first column that was not taken: a heap of the rows, each
// entered when the one before it was taken for the first time.
RankedList combine_ranked(const RankedList& a,
                          const RankedList& b,
                          std::size_t k,
                          double budget,
                          Combinations& combinations,
                          double* left_out,
                          const core::Deadline& deadline) {
  struct Sum {
    double slack;
    std::size_t i;
    std::size_t j;
    bool operator>(const Sum& other) const {
      return slack != other.slack ? slack > other.slack
                                  : std::pair(i, j) > std::pair(other.i, other.j);
    }
  };
  std::priority_queue<Sum, std::vector<Sum>, std::greater<>> next;
  const auto enter = [&](std::size_t i, std::size_t j) {
    if (i >= a.size() || j >= b.size()) return;
    const double slack = a[i].slack + b[j].slack;
    if (slack < budget) {
      next.push({slack, i, j});
    } else if (left_out != nullptr) {
      *left_out = std::min(*left_out, slack);
    }
  };
  RankedList sums;
  enter(0, 0);
  while (!next.empty() && sums.size() < k) {
    if (sums.size() % kSumsBetweenLooks == kSumsBetweenLooks - 1 && deadline.reached()) break;
    const Sum least = next.top();
    next.pop();
    sums.push_back({least.slack, combinations.join(a[least.i].arcs, b[least.j].arcs)});
    enter(least.i, least.j + 1);
    if (least.j == 0) enter(least.i + 1, 0);
  }
  return sums;
}

}  // namespace nda::kbest
