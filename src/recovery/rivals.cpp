#include "recovery/rivals.hpp"

#include <algorithm>

#include "core/cheapest.hpp"
#include "core/component.hpp"

namespace nda::recovery {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

double value_of(const bnb::SlackProblem& problem, std::uint32_t arc) {
  double saved = -problem.reduced(arc);
  for (const bnb::RowUse& use : problem.uses(arc))
    saved += problem.price(use.row) * use.coefficient;
  return saved;
}

}  // namespace

Rivals::Rivals(const bnb::SlackProblem& problem) {
  for (std::uint32_t a = 0; a < problem.num_arcs(); ++a) {
    if (value_of(problem, a) > 0) arcs_.push_back(a);
  }
  core::keep_cheapest(arcs_, kMostArcs, [&](std::uint32_t a) { return problem.reduced(a); });
  for (const std::uint32_t a : arcs_) value_.push_back(value_of(problem, a));
  list_rivals(problem);
}

void Rivals::list_rivals(const bnb::SlackProblem& problem) {
  const core::Lists<std::uint32_t> of_index(problem.num_indices(), [&](auto&& visit) {
    for (std::uint32_t n = 0; n < num_arcs(); ++n) {
      for (const bnb::RowUse& use : problem.index_uses(arcs_[n])) visit(use.row, n);
    }
  });
  std::vector<std::uint32_t> seen_by(num_arcs(), kNone);
  lists_ = core::Lists<std::uint32_t>(num_arcs(), [&](auto&& visit) {
    std::fill(seen_by.begin(), seen_by.end(), kNone);
    for (std::uint32_t n = 0; n < num_arcs(); ++n) {
      seen_by[n] = n;
      for (const bnb::RowUse& use : problem.index_uses(arcs_[n])) {
        work_ += static_cast<double>(of_index[use.row].size());
        for (const std::uint32_t rival : of_index[use.row]) {
          if (seen_by[rival] == n) continue;
          seen_by[rival] = n;
          visit(n, rival);
        }
      }
    }
  });
}

double Rivals::density() const {
  double num_rivals = 0;
  for (std::uint32_t n = 0; n < num_arcs(); ++n)
    num_rivals += static_cast<double>(lists_[n].size());
  return num_rivals / std::max(1.0, static_cast<double>(num_arcs()) * num_arcs());
}

std::vector<std::uint32_t> Rivals::arcs_of_problem(std::span<const std::uint32_t> numbers) const {
  std::vector<std::uint32_t> arcs = core::at_positions(arcs_, numbers);
  std::sort(arcs.begin(), arcs.end());
  return arcs;
}

}  // namespace nda::recovery
