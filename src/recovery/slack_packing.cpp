#include "recovery/slack_packing.hpp"

#include <algorithm>

namespace nda::recovery {

SlackPacking::SlackPacking(const bnb::SlackProblem& problem)
    : problem_(problem), owner_(problem.num_indices(), kNone), left_(problem.num_rows()) {
  assign({});
}

bool SlackPacking::fits(std::uint32_t arc) const {
  for (const bnb::RowUse& use : problem_.index_uses(arc)) {
    if (owner_[use.row] != kNone) return false;
  }
  return true;
}

void SlackPacking::insert(std::uint32_t arc) {
  slack_ += problem_.reduced(arc);
  for (const bnb::RowUse& use : problem_.uses(arc)) {
    if (is_index(use.row)) owner_[use.row] = arc;
    slack_ -= problem_.price(use.row) * use.coefficient;
    left_[use.row] -= use.coefficient;
  }
}

void SlackPacking::remove(std::uint32_t arc) {
  slack_ -= problem_.reduced(arc);
  for (const bnb::RowUse& use : problem_.uses(arc)) {
    if (is_index(use.row)) owner_[use.row] = kNone;
    slack_ += problem_.price(use.row) * use.coefficient;
    left_[use.row] += use.coefficient;
  }
}

std::vector<std::uint32_t> SlackPacking::arcs() const {
  std::vector<std::uint32_t> arcs;
  for (const std::uint32_t arc : owner_) {
    if (arc != kNone) arcs.push_back(arc);
  }
  std::sort(arcs.begin(), arcs.end());
  arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
  return arcs;
}

void SlackPacking::assign(std::span<const std::uint32_t> arcs) {
  std::fill(owner_.begin(), owner_.end(), kNone);
  slack_ = 0;
  for (std::uint32_t row = 0; row < problem_.num_rows(); ++row) {
    left_[row] = problem_.capacity(row);
    slack_ += unused(row);
  }
  for (const std::uint32_t arc : arcs) insert(arc);
}

}  // namespace nda::recovery
