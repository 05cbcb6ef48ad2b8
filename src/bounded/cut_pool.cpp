#include "bounded/cut_pool.hpp"

#include "cutting/separation.hpp"

namespace nda::bounded {
namespace {

using core::ArcId;

constexpr double kLeastViolation = 0.02;
constexpr std::size_t kMostCutsAtOnce = 150;
constexpr cutting::SeparationEffort kEffort{kLeastViolation, 2, 2};

core::Component packing_of(const BoundedComponent& component) {
  core::Component packing = component.graph;
  for (std::size_t k = 0; k < packing.sizes.size(); ++k) {
    const core::Column& from = component.graph.indices[k];
    const std::span<Index> to = packing.indices[k].allocate(from.size());
    for (std::size_t a = 0; a < from.size(); ++a)
      to[a] = component.rows[packing.offset[k] + from[a]].hi == 1 ? from[a] : 0;
  }
  return packing;
}

}  // namespace

CutPool::CutPool(const BoundedComponent& component, std::span<const ArcId> live)
    : packing_(packing_of(component)),
      live_(live.begin(), live.end()),
      arcs_(packing_, live_),
      lister_(packing_.num_arcs()) {}

std::size_t CutPool::separate(RelaxedProgram& program, const core::Deadline& deadline) {
  std::vector<double> x;
  for (const ArcId a : live_) x.push_back(program.use(a));
  cutting::Separator separator(packing_, live_, x);
  if (separator.integral()) return 0;
  std::vector<cutting::ViolatedCut> found = separator.three_rows(kLeastViolation, deadline);
  for (const cutting::Pattern& pattern : cutting::patterns()) {
    if (found.size() >= kMostCutsAtOnce / 4 || deadline.reached()) break;
    const auto more = separator.search(pattern, kEffort, random_(), deadline);
    found.insert(found.end(), more.begin(), more.end());
  }
  cutting::keep_most_violated(found, kMostCutsAtOnce);
  for (const cutting::ViolatedCut& violated : found) {
    cuts_.push_back({lister_.list(violated.cut, arcs_), violated.cut.right_side()});
    program.add_cut(cuts_.back().entries, cuts_.back().right_side);
  }
  return found.size();
}

CutPrices CutPool::prices(const RelaxedProgram& program) const {
  CutPrices prices;
  if (cuts_.empty()) return prices;
  prices.charge.assign(packing_.num_arcs(), 0.0);
  prices.num_cuts = cuts_.size();
  for (std::size_t c = 0; c < cuts_.size(); ++c) {
    const double dual = program.cut_dual(c);
    if (dual == 0) continue;
    prices.constant += dual * cuts_[c].right_side;
    for (const cutting::CutEntry& entry : cuts_[c].entries)
      prices.charge[entry.arc] += dual * entry.coefficient;
  }
  return prices;
}

}  // namespace nda::bounded
