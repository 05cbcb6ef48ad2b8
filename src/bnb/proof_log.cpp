#include "bnb/proof_log.hpp"

#include <algorithm>

#include "core/double_double.hpp"

// The checker judges the unshifted problem: there the multiplier of an index is its charge plus the
// shifted multiplier, whatever the charge was.  Indices whose arcs have all been fixed before what
// was entered last keep their charge.

namespace nda::bnb {
namespace {

bool has_point(ProofRule rule) {
  return rule == ProofRule::kBound || rule == ProofRule::kFix || rule == ProofRule::kSearch ||
         rule == ProofRule::kCliques;
}

// Strings steps of several logs together, each of which says only how its multipliers change.
class Weaver {
 public:
  explicit Weaver(std::size_t num_positions) : told_(num_positions, 0.0) {}

  // `state`: multipliers of the step's log before it, and after.
  void append(const ProofStep& step, std::vector<double>& state) {
    steps_.push_back(step);
    if (!has_point(step.rule)) return;
    for (const auto [position, value] : step.point.changes) state[position] = value;
    std::vector<ProofMultiplier>& changes = steps_.back().point.changes;
    if (last_ != &state) changes = changes_to(state);
    last_ = &state;
    for (const auto [position, value] : changes) told_[position] = value;
  }

  void append_all(const std::vector<ProofStep>& steps) {
    std::vector<double> state(told_.size(), 0.0);
    for (const ProofStep& step : steps) append(step, state);
    if (last_ == &state) last_ = nullptr;
  }

  std::vector<ProofStep> take(std::vector<double>& told) {
    told = std::move(told_);
    return std::move(steps_);
  }

 private:
  std::vector<ProofMultiplier> changes_to(const std::vector<double>& state) const {
    std::vector<ProofMultiplier> changes;
    for (std::uint32_t p = 0; p < state.size(); ++p) {
      if (state[p] != told_[p]) changes.push_back({p, state[p]});
    }
    return changes;
  }

  std::vector<double> told_;                   // multipliers after the steps so far
  const std::vector<double>* last_ = nullptr;  // whose they are
  std::vector<ProofStep> steps_;
};

}  // namespace

ProofLog::ProofLog(const core::Component& component, std::vector<double> base, double slack)
    : slack_(slack) {
  std::vector<std::uint32_t> all;
  core::for_each_index(component, [&](std::uint32_t slot, std::size_t k, Index i) {
    if (k >= position_of_.size()) position_of_.resize(k + 1);
    if (i >= position_of_[k].size()) position_of_[k].resize(i + std::size_t{1}, 0);
    position_of_[k][i] = static_cast<std::uint32_t>(base_.size());
    all.push_back(position_of_[k][i]);
    part_.indices.push_back({static_cast<int>(k), i});
    base_.push_back(base[slot]);
  });
  multipliers_.assign(base_.size(), 0.0);
  wanted_.assign(base_.size(), 0.0);
  scopes_.push_back(scope_of(std::move(all)));
  enter(component);
}

ProofLog::Scope ProofLog::scope_of(std::vector<std::uint32_t> positions) const {
  core::DoubleDouble constant;
  for (const std::uint32_t p : positions) constant.add(base_[p]);
  return {std::move(positions), constant.high()};
}

void ProofLog::enter(const core::Component& part) {
  position_.assign(part.num_slots(), 0);
  core::for_each_index(part, [&](std::uint32_t slot, std::size_t k, Index i) {
    position_[slot] = position_of_[k][i];
  });
}

void ProofLog::cut_back(std::size_t size) {
  part_.steps.resize(size);
  multipliers_.assign(base_.size(), 0.0);
  for (const ProofStep& step : part_.steps) {
    for (const auto [position, value] : step.point.changes) multipliers_[position] = value;
  }
}

ProofLog ProofLog::fork() const {
  ProofLog fork;
  fork.base_ = base_;
  fork.multipliers_.assign(base_.size(), 0.0);
  fork.wanted_ = wanted_;
  fork.position_of_ = position_of_;
  fork.position_ = position_;
  fork.scopes_ = scopes_;
  fork.slack_ = slack_;
  return fork;
}

void ProofLog::graft(std::span<const Graft> grafts) {
  Weaver weaver(base_.size());
  const std::vector<ProofStep> own = std::move(part_.steps);
  std::vector<double> state(base_.size(), 0.0);
  std::size_t next = 0;
  for (const Graft& graft : grafts) {
    for (; next < graft.place; ++next) weaver.append(own[next], state);
    weaver.append_all(graft.fork->part_.steps);
    graft.fork->part_.steps = {};
  }
  for (; next < own.size(); ++next) weaver.append(own[next], state);
  part_.steps = weaver.take(multipliers_);
}

void ProofLog::replace(ProofLog&& fork) {
  part_.steps = std::move(fork.part_.steps);
  multipliers_ = std::move(fork.multipliers_);
}

ProofPoint ProofLog::point(std::span<const double> u, std::vector<ProofCut> cuts) {
  const std::vector<std::uint32_t>& positions = scopes_.back().positions;
  for (const std::uint32_t p : positions) wanted_[p] = base_[p];
  // Dummies have u = 0.
  for (std::size_t slot = 0; slot < u.size(); ++slot) {
    if (u[slot] != 0) wanted_[position_[slot]] += u[slot];
  }
  ProofPoint point{{}, std::move(cuts)};
  for (const std::uint32_t p : positions) {
    if (wanted_[p] == multipliers_[p]) continue;
    multipliers_[p] = wanted_[p];
    point.changes.push_back({p, wanted_[p]});
  }
  for (ProofCut& cut : point.cuts) {
    for (std::uint32_t& slot : cut.positions) slot = position_[slot];
  }
  return point;
}

void ProofLog::fix(std::span<const double> u, double threshold, std::vector<ProofCut> cuts) {
  part_.steps.push_back({ProofRule::kFix, point(u, std::move(cuts)), unshifted(threshold), 0, 0});
}

void ProofLog::bound(std::span<const double> u, std::vector<ProofCut> cuts) {
  part_.steps.push_back({ProofRule::kBound, point(u, std::move(cuts)), 0, 0, 0});
}

void ProofLog::search(std::span<const double> u, double threshold, std::vector<ProofCut> cuts) {
  part_.steps.push_back(
      {ProofRule::kSearch, point(u, std::move(cuts)), unshifted(threshold), 0, 0});
}

void ProofLog::cliques(std::span<const double> u, double threshold) {
  part_.steps.push_back({ProofRule::kCliques, point(u, {}), unshifted(threshold), 0, 0});
}

void ProofLog::branch(std::uint32_t first, std::uint32_t second, bool together_first) {
  part_.steps.push_back({together_first ? ProofRule::kTogether : ProofRule::kApart,
                         {},
                         0,
                         position_[first],
                         position_[second]});
}

std::size_t ProofLog::cover(std::uint32_t slot) {
  part_.steps.push_back({ProofRule::kCover, {}, 0, position_[slot], 0});
  return part_.steps.size() - 1;
}

void ProofLog::use(std::size_t step, std::uint32_t arc, std::span<const std::uint32_t> slots) {
  part_.steps[step].uses.push_back(arc);
  std::vector<std::uint32_t> done;
  for (const std::uint32_t slot : slots) done.push_back(position_[slot]);
  leave_out(done);
}

void ProofLog::split(std::span<const core::Component* const> parts) {
  ProofStep step{ProofRule::kSplit, {}, 0, 0, 0};
  for (const core::Component* part : parts) step.groups.push_back(positions_of(*part));
  part_.steps.push_back(std::move(step));
}

void ProofLog::group(const core::Component& part) {
  scopes_.push_back(scope_of(positions_of(part)));
}

void ProofLog::rest(std::span<const core::Component* const> parts) {
  std::vector<std::uint32_t> elsewhere;
  for (const core::Component* part : parts) {
    const std::vector<std::uint32_t> positions = positions_of(*part);
    elsewhere.insert(elsewhere.end(), positions.begin(), positions.end());
  }
  leave_out(elsewhere);
}

std::vector<std::uint32_t> ProofLog::positions_of(const core::Component& part) const {
  std::vector<std::uint32_t> positions;
  core::for_each_index(part, [&](std::uint32_t, std::size_t k, Index i) {
    positions.push_back(position_of_[k][i]);
  });
  return positions;
}

// The scope without these positions.
void ProofLog::leave_out(std::span<const std::uint32_t> positions) {
  std::vector<bool> out(base_.size(), false);
  for (const std::uint32_t p : positions) out[p] = true;
  std::vector<std::uint32_t> left;
  for (const std::uint32_t p : scopes_.back().positions) {
    if (!out[p]) left.push_back(p);
  }
  scopes_.push_back(scope_of(std::move(left)));
}

}  // namespace nda::bnb
