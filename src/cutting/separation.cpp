#include "cutting/separation.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <unordered_set>

// Three rows: a violated clique has weight on all three pairs of rows, so enumerating triangles
// finds every one (Balas & Saltzman 1989 have O(n^4) for dense problems; the support is sparse).
//
// More rows: which row takes which weight is found by coordinate ascent.  A position is given to
// the row that gains most, the other positions held; only arcs that touch the other rows can gain,
// so a step costs a few hundred operations, and all rows can serve as seeds.  A small convex term
// leads towards arcs that are nearly worth a coefficient.

namespace nda::cutting {
namespace {

using core::ArcId;

constexpr double kIntegral = 1e-6;
constexpr double kConvex = 0.02;
constexpr double kTie = 1e-12;
constexpr int kSweeps = 4;
constexpr std::size_t kPatience = 50;
constexpr std::size_t kShortPatience = 12;  // where rows are few
constexpr std::size_t kEnough = 150;
constexpr double kNoise = 0.5;
constexpr std::uint32_t kNone = ~std::uint32_t{0};

const std::array<Pattern, 13> kPatterns = {{{{1, 1, 1, 1, 1}, 2},
                                            {{3, 3, 2, 2, 1}, 4},
                                            {{1, 1, 1, 1, 1, 1, 1}, 2},
                                            {{3, 2, 2, 1, 1}, 5},
                                            {{2, 2, 1, 1, 1}, 4},
                                            {{3, 1, 1, 1, 1}, 4},
                                            {{2, 1, 1, 1}, 3},
                                            {{1, 1, 1, 1}, 3},
                                            {{2, 2, 1, 1, 1}, 3},
                                            {{1, 1, 1, 1, 1}, 3},
                                            {{1, 1, 1, 1, 1, 1, 1, 1}, 3},
                                            {{5, 5, 4, 3, 2, 1, 1, 1, 1}, 6},
                                            {{3, 3, 3, 1, 1, 1, 1, 1, 1}, 4}}};

std::size_t hash_of(const Cut& cut) {
  std::size_t hash = cut.divisor;
  const auto mix = [&](std::size_t value) { hash = (hash ^ value) * 0x100000001b3ULL + 0x9e37; };
  for (const std::uint32_t slot : cut.slots) mix(slot);
  for (const std::uint8_t weight : cut.weights) mix(weight);
  return hash;
}

}  // namespace

void keep_most_violated(std::vector<ViolatedCut>& cuts, std::size_t most) {
  const auto order = [](const ViolatedCut& a, const ViolatedCut& b) {
    if (a.violation != b.violation) return a.violation > b.violation;
    return a.cut.slots < b.cut.slots;
  };
  std::sort(cuts.begin(), cuts.end(), order);
  if (cuts.size() > most) cuts.resize(most);
}

std::span<const Pattern> patterns() {
  return kPatterns;
}

Separator::Separator(const core::Component& component,
                     std::span<const ArcId> arcs,
                     std::span<const double> x) {
  std::vector<std::uint32_t> row_of_slot(component.num_slots(), kNone);
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    if (x[k] <= kIntegral || x[k] >= 1 - kIntegral) continue;
    value_.push_back(x[k]);
    core::for_each_slot(component, arcs[k], [&](std::uint32_t slot) {
      if (row_of_slot[slot] == kNone) {
        row_of_slot[slot] = static_cast<std::uint32_t>(slot_of_row_.size());
        slot_of_row_.push_back(slot);
      }
      arc_rows_.push_back(row_of_slot[slot]);
    });
    arc_start_.push_back(static_cast<std::uint32_t>(arc_rows_.size()));
  }
  row_arcs_ = core::Lists<std::uint32_t>(num_rows(), [&](auto&& visit) {
    for (std::uint32_t a = 0; a < value_.size(); ++a) {
      for (const std::uint32_t row : rows_of(a)) visit(row, a);
    }
  });
  arc_weight_.assign(value_.size(), 0);
  seen_.assign(value_.size(), 0);
  score_.assign(num_rows(), 0.0);
  taken_.assign(num_rows(), 0);
}

std::vector<std::vector<Separator::Neighbour>> Separator::later_neighbours() const {
  std::vector<std::vector<Neighbour>> later(num_rows());
  std::vector<double> weight(num_rows(), 0.0);
  for (std::uint32_t row = 0; row < num_rows(); ++row) {
    for (const std::uint32_t a : arcs_of(row)) {
      for (const std::uint32_t other : rows_of(a)) {
        if (other <= row) continue;
        if (weight[other] == 0) later[row].push_back({other, 0.0});
        weight[other] += value_[a];
      }
    }
    for (Neighbour& neighbour : later[row]) {
      neighbour.weight = weight[neighbour.row];
      weight[neighbour.row] = 0;
    }
  }
  return later;
}

double Separator::all_three(std::uint32_t r, std::uint32_t s, std::uint32_t t) const {
  double sum = 0;
  for (const std::uint32_t a : arcs_of(r)) {
    int others = 0;
    for (const std::uint32_t row : rows_of(a)) others += row == s || row == t ? 1 : 0;
    if (others == 2) sum += value_[a];
  }
  return sum;
}

std::vector<ViolatedCut> Separator::three_rows(double least, const core::Deadline& deadline) const {
  const std::vector<std::vector<Neighbour>> later = later_neighbours();
  const Pattern pattern = {{1, 1, 1}, 2};
  std::vector<ViolatedCut> found;
  std::vector<double> to_r(num_rows(), 0.0);
  for (std::uint32_t r = 0; r < num_rows() && !deadline.reached(); ++r) {
    for (const Neighbour& s : later[r]) to_r[s.row] = s.weight;
    for (const Neighbour& s : later[r]) {
      for (const Neighbour& t : later[s.row]) {
        if (to_r[t.row] == 0 || s.weight + t.weight + to_r[t.row] <= 1 + least) continue;
        const double three = all_three(r, s.row, t.row);
        const double violation = s.weight + t.weight + to_r[t.row] - 2 * three - 1;
        if (violation <= least) continue;
        found.push_back({cut_of(std::array{r, s.row, t.row}, pattern), violation});
      }
    }
    for (const Neighbour& s : later[r]) to_r[s.row] = 0;
  }
  return found;
}

// What an arc of weight w gains by one more of weight `weight`.
void Separator::prepare(const Pattern& pattern) {
  int total = 0;
  for (const int weight : pattern.weights) total += weight;
  const int divisor = pattern.divisor;
  gain_.assign(pattern.weights.size(), std::vector<double>(static_cast<std::size_t>(total) + 1));
  for (std::size_t position = 0; position < gain_.size(); ++position) {
    const int weight = pattern.weights[position];
    for (int before = 0; before <= total; ++before) {
      const int gained = (before + weight) / divisor - before / divisor;
      gain_[position][static_cast<std::size_t>(before)] =
          gained + kConvex * weight * (2 * before + weight) / (divisor * divisor);
    }
  }
}

// Gives a position to a row, or takes it away.
void Separator::place(const Pattern& pattern, std::size_t position, std::uint32_t row) {
  const std::uint32_t held = chosen_[position];
  const int weight = pattern.weights[position];
  if (held != kNone) {
    for (const std::uint32_t a : arcs_of(held)) arc_weight_[a] -= weight;
    taken_[held] = false;
  }
  if (row != kNone) {
    for (const std::uint32_t a : arcs_of(row)) arc_weight_[a] += weight;
    taken_[row] = true;
  }
  chosen_[position] = row;
}

// Scores all rows for a position that is free, returns the best, or kNone.  Equal rows: `held`,
// then the first.
std::uint32_t Separator::best_row(std::size_t position, std::uint32_t held, double noise) {
  ++stamp_;
  for (const std::uint32_t member : chosen_) {
    if (member == kNone) continue;
    for (const std::uint32_t a : arcs_of(member)) {
      if (seen_[a] == stamp_) continue;
      seen_[a] = stamp_;
      work_ += static_cast<double>(rows_of(a).size());
      const double gain = value_[a] * gain_[position][static_cast<std::size_t>(arc_weight_[a])];
      for (const std::uint32_t row : rows_of(a)) {
        if (score_[row] == 0) scored_.push_back(row);
        score_[row] += gain;
      }
    }
  }
  std::uint32_t best = kNone;
  for (const std::uint32_t row : scored_) {
    if (noise > 0) score_[row] *= 1 + noise * random_.uniform();
    if (!taken_[row] && (best == kNone || score_[row] > score_[best] + kTie)) best = row;
  }
  if (held != kNone && best != kNone && score_[held] >= score_[best] - kTie) best = held;
  for (const std::uint32_t row : scored_) score_[row] = 0;
  scored_.clear();
  return best;
}

// Ascends from a row at the first position; false when the pattern does not fit around it.
bool Separator::climb(const Pattern& pattern, std::uint32_t seed, double noise) {
  place(pattern, 0, seed);
  for (std::size_t position = 1; position < chosen_.size(); ++position) {
    const std::uint32_t row = best_row(position, kNone, noise);
    if (row == kNone) return false;
    place(pattern, position, row);
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bool moved = false;
    for (std::size_t position = 0; position < chosen_.size(); ++position) {
      const std::uint32_t held = chosen_[position];
      place(pattern, position, kNone);
      const std::uint32_t row = best_row(position, held, 0.0);
      place(pattern, position, row == kNone ? held : row);
      moved = moved || chosen_[position] != held;
    }
    if (!moved) break;
  }
  return true;
}

double Separator::violation(const Pattern& pattern) {
  double left = 0;
  ++stamp_;
  for (const std::uint32_t row : chosen_) {
    for (const std::uint32_t a : arcs_of(row)) {
      if (seen_[a] != stamp_) left += value_[a] * (arc_weight_[a] / pattern.divisor);
      seen_[a] = stamp_;
    }
  }
  int total = 0;
  for (const int weight : pattern.weights) total += weight;
  return left - total / pattern.divisor;
}

std::vector<ViolatedCut> Separator::search(const Pattern& pattern,
                                           const SeparationEffort& effort,
                                           std::uint64_t seed,
                                           const core::Deadline& deadline) {
  std::vector<ViolatedCut> found;
  std::unordered_set<std::size_t> seen;
  random_ = core::Random(seed);
  prepare(pattern);
  chosen_.assign(pattern.weights.size(), kNone);
  std::vector<std::uint32_t> seeds(num_rows());
  std::iota(seeds.begin(), seeds.end(), 0u);
  core::shuffle(seeds, random_);
  const std::size_t least = seeds.size() <= kFewRows ? kShortPatience : kPatience;
  const std::size_t patience = (least + seeds.size() / 8) * effort.patience;
  const std::size_t enough = kEnough + seeds.size() / 4;
  std::size_t fruitless = 0;
  for (std::size_t k = 0; k < effort.starts * seeds.size(); ++k) {
    if (++fruitless > patience || found.size() >= enough) break;
    if (k % 64 == 0 && deadline.reached()) break;
    if (climb(pattern, seeds[k % seeds.size()], k < seeds.size() ? 0.0 : kNoise)) {
      const double violated = violation(pattern);
      ViolatedCut candidate = {cut_of(chosen_, pattern), violated};
      if (violated > effort.least_violation && seen.insert(hash_of(candidate.cut)).second) {
        found.push_back(std::move(candidate));
        fruitless = 0;
      }
    }
    for (std::size_t position = 0; position < chosen_.size(); ++position) {
      place(pattern, position, kNone);
    }
  }
  return found;
}

Cut Separator::cut_of(std::span<const std::uint32_t> rows, const Pattern& pattern) const {
  std::vector<std::pair<std::uint32_t, std::uint8_t>> members;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    members.emplace_back(slot_of_row_[rows[i]], pattern.weights[i]);
  }
  std::sort(members.begin(), members.end());
  Cut cut;
  cut.divisor = pattern.divisor;
  for (const auto& [slot, weight] : members) {
    cut.slots.push_back(slot);
    cut.weights.push_back(weight);
  }
  return cut;
}

}  // namespace nda::cutting
