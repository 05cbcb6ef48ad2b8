#include "cutting/proof_log.hpp"

#include <algorithm>

#include "core/double_double.hpp"

// The checker judges the unshifted problem: there the multiplier of an index is its charge plus the
// shifted multiplier, whatever the charge was.  Indices whose arcs have all been fixed before what
// was entered last keep their charge.

namespace nda::cutting {
namespace {

// Strings steps of several logs together, each of which says only how its multipliers change.
class Weaver {
 public:
  explicit Weaver(std::size_t num_positions) : told_(num_positions, 0.0) {}

  // `state`: multipliers of the step's log before it, and after.
  void append(const ProofStep& step, std::vector<double>& state) {
    steps_.push_back(step);
    const bool has_point = step.rule != ProofRule::kTogether && step.rule != ProofRule::kApart;
    if (!has_point) return;
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
  core::DoubleDouble constant;
  core::for_each_index(component, [&](std::uint32_t slot, std::size_t k, Index i) {
    if (k >= position_of_.size()) position_of_.resize(k + 1);
    if (i >= position_of_[k].size()) position_of_[k].resize(i + std::size_t{1}, 0);
    position_of_[k][i] = static_cast<std::uint32_t>(base_.size());
    part_.indices.push_back({static_cast<int>(k), i});
    base_.push_back(base[slot]);
    constant.add(base[slot]);
  });
  constant_ = constant.high();
  multipliers_.assign(base_.size(), 0.0);
  enter(component);
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
  fork.position_of_ = position_of_;
  fork.position_ = position_;
  fork.constant_ = constant_;
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

ProofPoint ProofLog::point(std::span<const double> u) {
  std::vector<double> multipliers = base_;
  // Dummies are at position 0 with u = 0.
  for (std::size_t slot = 0; slot < u.size(); ++slot) {
    if (u[slot] != 0) multipliers[position_[slot]] += u[slot];
  }
  ProofPoint point;
  for (std::uint32_t p = 0; p < multipliers.size(); ++p) {
    if (multipliers[p] != multipliers_[p]) point.changes.push_back({p, multipliers[p]});
  }
  multipliers_ = std::move(multipliers);
  return point;
}

ProofPoint ProofLog::point(const Master& master, std::span<const double> u) {
  ProofPoint point = this->point(u);
  for (const CutRow& row : master.cuts()) {
    if (row.multiplier == 0) continue;
    ProofCut cut{{}, row.cut.weights, row.cut.divisor, row.multiplier};
    for (const std::uint32_t slot : row.cut.slots) cut.positions.push_back(position_[slot]);
    point.cuts.push_back(std::move(cut));
  }
  return point;
}

void ProofLog::fix(std::span<const double> u, double threshold) {
  part_.steps.push_back({ProofRule::kFix, point(u), unshifted(threshold), 0, 0});
}

void ProofLog::fix(const Master& master, double threshold) {
  part_.steps.push_back({ProofRule::kFix, point(master, master.u()), unshifted(threshold), 0, 0});
}

void ProofLog::bound(std::span<const double> u) {
  part_.steps.push_back({ProofRule::kBound, point(u), 0, 0, 0});
}

void ProofLog::bound(const Master& master) {
  part_.steps.push_back({ProofRule::kBound, point(master, master.u()), 0, 0, 0});
}

void ProofLog::search(std::span<const double> u, double threshold) {
  part_.steps.push_back({ProofRule::kSearch, point(u), unshifted(threshold), 0, 0});
}

void ProofLog::search(const Master& master, std::span<const double> u, double threshold) {
  part_.steps.push_back({ProofRule::kSearch, point(master, u), unshifted(threshold), 0, 0});
}

void ProofLog::cliques(std::span<const double> u, double threshold) {
  part_.steps.push_back({ProofRule::kCliques, point(u), unshifted(threshold), 0, 0});
}

void ProofLog::branch(std::uint32_t first, std::uint32_t second, bool together_first) {
  part_.steps.push_back({together_first ? ProofRule::kTogether : ProofRule::kApart,
                         {},
                         0,
                         position_[first],
                         position_[second]});
}

}  // namespace nda::cutting
