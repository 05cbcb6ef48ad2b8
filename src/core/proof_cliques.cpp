#include "core/proof_cliques.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "core/part_proof.hpp"
#include "nda/proof.hpp"

// The checker's own search over arcs that exclude each other, the idea of bnb/clique_search.cpp
// written a second time.  Units are so small that all gains add up to 2^60 of them, and every gain
// is rounded up to units, so what is lost is on the safe side.
//
// Why it loses nothing: the gains of some open arcs are shared out among sets of arcs that exclude
// each other pairwise.  Each such set pays at most its share.  If the shares add up to no more than
// what must be beaten, a choice of those arcs alone does not beat it; so it has one of the others.
// These are tried one after the other, each together with what was tried before it.

namespace nda::core {
namespace {

using Units = std::int64_t;
using Word = std::uint64_t;

constexpr int kExponent = 60;
constexpr double kMostUnits = 0x1p61;
constexpr double kLeastUnit = std::numeric_limits<double>::denorm_min();
constexpr std::size_t kMostArcs = 4096;
constexpr std::size_t kWordBits = 64;

class CliqueProof {
 public:
  CliqueProof(const CliqueTask& task, double& work, double most_work)
      : work_(work),
        most_work_(most_work),
        num_arcs_(task.gain.size()),
        num_words_((num_arcs_ + kWordBits - 1) / kWordBits),
        work_of_look_(1 + 0.06 * static_cast<double>(num_words_)),
        excludes_(num_arcs_ * num_words_, 0),
        open_gain_(num_arcs_, 0),
        candidates_(num_words_) {
    double total = 0;
    for (const double gain : task.gain) total += gain;
    if (!std::isfinite(total)) throw ProofFault{"the gains of the search are too large"};
    if (total > 0) unit_ = std::max(kLeastUnit, std::ldexp(1.0, std::ilogb(total) + 1 - kExponent));
    for (const double gain : task.gain)
      gain_.push_back(static_cast<Units>(std::ceil(gain / unit_)));
    note_exclusions(task);
  }

  double run(double target) {
    const double units = std::floor(target / unit_);
    if (units >= kMostUnits) return target;
    const Units least = units < 0 ? Units{-1} : static_cast<Units>(units);
    std::vector<Word> all(num_words_, 0);
    for (std::uint32_t a = 0; a < num_arcs_; ++a) set(all, a);
    const Units most = beat(all, least, 0);
    if (most <= least) return target;
    return std::nextafter(static_cast<double>(most) * unit_,
                          std::numeric_limits<double>::infinity());
  }

 private:
  void note_exclusions(const CliqueTask& task) {
    std::uint32_t num_indices = 0;
    for (const auto& indices : task.indices) {
      for (const std::uint32_t i : indices) num_indices = std::max(num_indices, i + 1);
    }
    std::vector<std::vector<std::uint32_t>> users(num_indices);
    for (std::uint32_t a = 0; a < num_arcs_; ++a) {
      for (const std::uint32_t i : task.indices[a]) users[i].push_back(a);
    }
    for (const std::vector<std::uint32_t>& group : users) {
      spend(group.size() * group.size());
      for (const std::uint32_t a : group) {
        for (const std::uint32_t b : group) {
          if (a != b) excludes_[a * num_words_ + b / kWordBits] |= Word{1} << b % kWordBits;
        }
      }
    }
  }

  const Word* excluded_by(std::uint32_t a) const { return &excludes_[a * num_words_]; }

  static void set(std::vector<Word>& words, std::uint32_t a) {
    words[a / kWordBits] |= Word{1} << a % kWordBits;
  }
  static void clear(std::vector<Word>& words, std::uint32_t a) {
    words[a / kWordBits] &= ~(Word{1} << a % kWordBits);
  }
  static bool has(const std::vector<Word>& words, std::uint32_t a) {
    return (words[a / kWordBits] >> a % kWordBits & 1) != 0;
  }

  std::uint32_t num_excluded(std::uint32_t a, const std::vector<Word>& among) const {
    const Word* row = excluded_by(a);
    int count = 0;
    for (std::size_t w = 0; w < num_words_; ++w) count += std::popcount(row[w] & among[w]);
    return static_cast<std::uint32_t>(count);
  }

  template <typename Visit>
  void for_each(const std::vector<Word>& words, Visit&& visit) const {
    for (std::size_t w = 0; w < num_words_; ++w) {
      for (Word rest = words[w]; rest != 0; rest &= rest - 1)
        visit(static_cast<std::uint32_t>(w * kWordBits) +
              static_cast<std::uint32_t>(std::countr_zero(rest)));
    }
  }

  // The greatest gain of open arcs, if it beats `least`, else `least`.
  Units beat(std::vector<Word>& open, Units least, std::size_t depth) {
    if (depth > std::size_t{kMostProofSearchDepth}) throw ProofFault{"the search is too deep"};
    std::vector<std::uint32_t> branches;
    const Units nothing = std::max<Units>(0, least);
    if (find_branches(open, nothing, branches)) return nothing;
    if (levels_.size() <= depth) levels_.resize(depth + 1, std::vector<Word>(num_words_));
    Units most = nothing;
    for (const std::uint32_t a : branches) clear(open, a);
    for (const std::uint32_t a : branches) {
      std::vector<Word> left = std::move(levels_[depth]);
      for (std::size_t w = 0; w < num_words_; ++w) left[w] = open[w] & ~excluded_by(a)[w];
      most = std::max(most, gain_[a] + beat(left, most - gain_[a], depth + 1));
      levels_[depth] = std::move(left);
      set(open, a);
    }
    return most;
  }

  // Shares out gains for up to `budget`; returns whether all open arcs were charged in full.
  bool find_branches(const std::vector<Word>& open,
                     Units budget,
                     std::vector<std::uint32_t>& branches) {
    order_.clear();
    for_each(open, [&](std::uint32_t a) {
      open_gain_[a] = gain_[a];
      order_.emplace_back(num_excluded(a, open), a);
    });
    spend(order_.size());
    std::sort(order_.begin(), order_.end());
    uncharged_ = open;
    for (const auto& [degree, a] : order_) {
      while (has(uncharged_, a) && budget > 0) share_out(a, budget);
      if (has(uncharged_, a)) branches.push_back(a);
    }
    return branches.empty();
  }

  // Charges one set of arcs that exclude each other pairwise, one of which is `first`.
  void share_out(std::uint32_t first, Units& budget) {
    group_.assign(1, first);
    Units share = std::min(budget, open_gain_[first]);
    restrict_to(uncharged_, first);
    for (std::uint32_t next = 0; most_promising(next);) {
      group_.push_back(next);
      share = std::min(share, open_gain_[next]);
      restrict_to(candidates_, next);
    }
    for (const std::uint32_t a : group_) {
      open_gain_[a] -= share;
      if (open_gain_[a] == 0) clear(uncharged_, a);
    }
    budget -= share;
  }

  void restrict_to(const std::vector<Word>& from, std::uint32_t a) {
    for (std::size_t w = 0; w < num_words_; ++w) candidates_[w] = from[w] & excluded_by(a)[w];
  }

  // The candidate with the greatest product of gain and further candidates; false if there is none.
  bool most_promising(std::uint32_t& arc) {
    double most = 0;
    std::size_t looks = 0;
    for_each(candidates_, [&](std::uint32_t a) {
      ++looks;
      const double promise =
          static_cast<double>(open_gain_[a]) * (1.0 + num_excluded(a, candidates_));
      if (promise <= most) return;
      most = promise;
      arc = a;
    });
    spend(looks);
    return most > 0;
  }

  void spend(std::size_t looks) {
    work_ += static_cast<double>(looks) * work_of_look_;
    if (work_ > most_work_) throw ProofFault{"the search takes too long"};
  }

  double& work_;
  const double most_work_;
  const std::size_t num_arcs_;
  const std::size_t num_words_;
  const double work_of_look_;
  double unit_ = 1;
  std::vector<Units> gain_;
  std::vector<Word> excludes_;  // [arc][word]
  std::vector<std::vector<Word>> levels_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order_;
  std::vector<Units> open_gain_;  // not yet shared out
  std::vector<Word> uncharged_;
  std::vector<Word> candidates_;
  std::vector<std::uint32_t> group_;
};

}  // namespace

double most_gain(const CliqueTask& task, double target, double& work, double most_work) {
  if (task.gain.size() > kMostArcs) throw ProofFault{"the search has too many arcs"};
  return CliqueProof(task, work, most_work).run(target);
}

}  // namespace nda::core
