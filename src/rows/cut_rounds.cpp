#include "rows/cut_rounds.hpp"

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "bnb/proof_log.hpp"
#include "cutting/cut_bound.hpp"
#include "cutting/separation.hpp"
#include "dual/maximize.hpp"
#include "rows/cut_dual.hpp"

// Cuts without a linear program.  What the simplex method gives, a point to separate, the volume
// algorithm gives approximately, as the average of the relaxed solutions that its subgradients come
// from (Barahona & Anbil 2000); the bundle gives the same from its master problem.  Such a point is
// off by what is left of its convergence, so only cuts that are violated by more than that are
// believed.  Nothing else depends on it: a bound is computed from the multipliers alone, whatever
// they are.
//
// Every evaluation passes over all arcs, so they are dropped as soon as reduced costs allow, and
// what is left is cut out as a component of its own.

namespace nda::rows {
namespace {

using core::ArcId;
using core::Component;
using cutting::CutRow;

constexpr std::size_t kLeastCuts = 400;
constexpr std::size_t kIndicesPerCut = 5;
constexpr int kMostIdle = 2;       // rounds of a cut without a multiplier
constexpr int kPatience = 1;       // rounds of little gain in a row
constexpr double kShrunk = 0.9;    // arcs left, as a share of those evaluated: worth a copy
constexpr double kNothing = 1e-3;  // of a value in an average
constexpr int kLeastDimensions = 3;
// Every round but the first begins near its maximum, and with a single subgradient.
constexpr dual::VolumeSteps kNearTheTop = {0.1, 5};
// Time kept for the certificate of a round, as a multiple of what the last took.
constexpr double kCertifyReserve = 1.3;

// The relaxed solutions of a run and what they are on average.
class Average {
 public:
  void clear() {
    chosen_.clear();
    end_.clear();
  }
  void add(std::span<const ArcId> chosen) {
    chosen_.insert(chosen_.end(), chosen.begin(), chosen.end());
    end_.push_back(chosen_.size());
  }
  // weights[e] counts for solution number e.
  void take(std::span<const double> weights, std::size_t num_arcs) {
    std::vector<double> value(num_arcs, 0.0);
    for (std::size_t e = 0, i = 0; e < end_.size(); ++e) {
      for (; i < end_[e]; ++i) value[chosen_[i]] += weights[e];
    }
    arcs_.clear();
    values_.clear();
    for (ArcId a = 0; a < num_arcs; ++a) {
      if (value[a] < kNothing) continue;
      arcs_.push_back(a);
      values_.push_back(value[a]);
    }
  }

  std::span<const ArcId> arcs() const { return arcs_; }
  std::span<const double> values() const { return values_; }

 private:
  std::vector<ArcId> chosen_;
  std::vector<std::size_t> end_;
  std::vector<ArcId> arcs_;
  std::vector<double> values_;
};

class Rounds {
 public:
  Rounds(const Component& component,
         std::span<const double> u,
         const CutRoundOptions& options,
         const CutPointObserver& observer)
      : source_(component), options_(options), observer_(observer), cutoff_(options.cutoff) {
    component_ = &source_;
    u_.assign(u.begin(), u.end());
    enter();
  }

  CutRoundsResult run() {
    int idle = 0;
    while (result_.rounds < options_.max_rounds && climb()) {
      const double gain = lower_ - result_.lower;
      result_.lower = lower_;
      ++result_.rounds;
      cutoff_ = observer_({*component_, lower_, u_, rows_, average_.arcs(), average_.values()});
      if (lower_ >= cutoff_ || !fix()) break;
      idle = gain < options_.worthwhile * (cutoff_ - lower_) ? idle + 1 : 0;
      if (idle > kPatience || !renew_rows(idle)) break;
    }
    finish();
    return std::move(result_);
  }

 private:
  // Everything that belongs to the component to work on.
  void enter() {
    live_ = core::all_arcs(*component_);
    reduced_.assign(component_->num_arcs(), 0.0);
    dual_ = std::make_unique<CutDual>(*component_, options_.assign2d, options_.deadline);
  }

  // Maximises the dual function with the present cuts; false where that gained nothing.
  bool climb() {
    const core::Deadline deadline = options_.deadline.earlier(certify_s_);
    if (deadline.reached()) return false;
    std::vector<double> point(u_.begin() + dual_->first_slot(), u_.end());
    for (const CutRow& row : rows_) point.push_back(row.multiplier);
    dual::MaximizeOptions limits;
    limits.max_evaluations = options_.round_evaluations;
    limits.primal_weights = true;
    limits.volume = kNearTheTop;
    limits.target = cutoff_;
    if (cutoff_ < kInfinity && lower_ > -kInfinity) limits.expected_increase = cutoff_ - lower_;
    average_.clear();
    core::Stopwatch watch;
    const auto observe = [&](const dual::Iterate&) {
      ++result_.evaluations;
      average_.add(dual_->chosen_arcs());
      const double step_s = std::exchange(watch, core::Stopwatch()).seconds();
      return !deadline.reached() && deadline.remaining_s() > step_s;
    };
    const dual::MaximizeResult found =
        dual::maximize(options_.dual_method, *dual_, point, limits, observe);
    average_.take(found.primal_weights, component_->num_arcs());
    dual_->evaluate(found.point, point);
    ++result_.evaluations;
    return accept_last();
  }

  // Takes the multipliers of the last evaluation if they prove more than those before.
  bool accept_last() {
    const core::Stopwatch watch;
    std::vector<double> u(component_->num_slots(), 0.0);
    std::vector<double> of_rows(rows_.size());
    if (!dual_->certify(u, of_rows, options_.deadline)) return false;
    std::vector<CutRow> rows = rows_;
    for (std::size_t c = 0; c < rows.size(); ++c) rows[c].multiplier = of_rows[c];
    const double lower = cutting::price(*component_, live_, u, rows, {}, reduced_);
    certify_s_ = kCertifyReserve * watch.seconds();
    if (lower <= lower_) return false;
    lower_ = lower;
    u_ = std::move(u);
    rows_ = std::move(rows);
    dual_->set_rows(rows_);
    return true;
  }

  // Drops arcs that no packing below the cutoff uses; false where that leaves none.
  bool fix() {
    const auto dead = [&](ArcId a) { return lower_ + reduced_[a] >= cutoff_; };
    if (std::erase_if(live_, dead) > 0 && options_.proof != nullptr)
      options_.proof->fix(u_, cutoff_, cutting::proof_cuts(rows_));
    if (!live_.empty()) return true;
    result_.lower = std::min(0.0, cutoff_);
    std::fill(u_.begin(), u_.end(), 0.0);
    rows_.clear();
    return false;
  }

  // The cuts of the next round, and its arcs; false where there is nothing new to gain.
  bool renew_rows(int idle) {
    std::vector<CutRow> next = rows_;
    for (CutRow& row : next) row.idle = row.multiplier < 0 ? 0 : row.idle + 1;
    std::erase_if(next, [](const CutRow& row) { return row.idle >= kMostIdle; });
    const std::size_t num_kept = next.size();
    add_violated(next);
    if (idle > 0 && next.size() == num_kept) return false;
    const bool smaller =
        static_cast<double>(live_.size()) < kShrunk * static_cast<double>(component_->num_arcs());
    if (smaller && !shrink(next)) return false;
    cutting::CutLister lister(component_->num_arcs());
    const cutting::SlotIndex index(*component_, live_);
    for (CutRow& row : next) {
      if (row.entries.empty()) row.entries = lister.list(row.cut, index);
    }
    rows_ = std::move(next);
    dual_->set_rows(rows_);
    return true;
  }

  void add_violated(std::vector<CutRow>& next) const {
    std::set<std::vector<std::uint32_t>> known;
    for (const CutRow& row : next) known.insert(row.cut.slots);
    const cutting::Separator separator(*component_, average_.arcs(), average_.values());
    std::vector<cutting::ViolatedCut> found =
        separator.three_rows(options_.least_violation, options_.deadline);
    std::erase_if(found, [&](const auto& violated) { return known.contains(violated.cut.slots); });
    cutting::keep_most_violated(found,
                                std::max(kLeastCuts, component_->num_indices() / kIndicesPerCut));
    for (cutting::ViolatedCut& violated : found)
      next.push_back({std::move(violated.cut), {}, 0, 0});
  }

  // Goes on with the live arcs alone; false where nothing is left to relax.
  bool shrink(std::vector<CutRow>& next) {
    auto smaller = std::make_unique<Component>(cutter_.cut(*component_, live_));
    if (smaller->num_dimensions() < kLeastDimensions) return false;
    const std::vector<std::uint32_t> slots = core::slots_in_part(*component_, *smaller);
    for (CutRow& row : next)
      row = {cutting::restrict_cut(row.cut, slots), {}, row.multiplier, row.idle};
    std::erase_if(next, [](const CutRow& row) { return row.cut.slots.size() < 2; });
    u_ = core::restrict_slots(*component_, u_, *smaller);
    dual_.reset();
    own_ = std::move(smaller);
    component_ = own_.get();
    if (options_.proof != nullptr) options_.proof->enter(*component_);
    enter();
    return true;
  }

  // Back to the slots and arcs of the source.
  void finish() {
    result_.u.assign(source_.num_slots(), 0.0);
    core::extend_slots(*component_, u_, source_, result_.u);
    std::vector<std::uint32_t> source_slot(component_->num_slots(), 0);
    const std::vector<std::uint32_t> slots = core::slots_in_part(source_, *component_);
    for (std::uint32_t slot = 0; slot < slots.size(); ++slot) source_slot[slots[slot]] = slot;
    for (CutRow& row : rows_) {
      row.entries.clear();
      for (std::uint32_t& slot : row.cut.slots) slot = source_slot[slot];
    }
    result_.rows = std::move(rows_);
    if (component_ != &source_) {
      live_ = core::arcs_from_part(source_, *component_, std::move(live_));
      if (options_.proof != nullptr) options_.proof->enter(source_);
    }
    result_.live = std::move(live_);
  }

  const Component& source_;
  const CutRoundOptions& options_;
  const CutPointObserver& observer_;
  double cutoff_;
  core::Cutter cutter_;
  std::unique_ptr<Component> own_;  // once arcs were cut off
  const Component* component_;      // what is worked on
  std::unique_ptr<CutDual> dual_;
  std::vector<ArcId> live_;  // of it
  std::vector<double> u_;    // by slot of it: with the cuts they prove lower_
  std::vector<CutRow> rows_;
  std::vector<double> reduced_;  // [arc], of live ones
  double lower_ = -kInfinity;
  double certify_s_ = options_.certify_s;
  Average average_;
  CutRoundsResult result_;
};

}  // namespace

CutRoundsResult run_cut_rounds(const Component& component,
                               std::span<const double> u,
                               const CutRoundOptions& options,
                               const CutPointObserver& observer) {
  return Rounds(component, u, options, observer).run();
}

}  // namespace nda::rows
