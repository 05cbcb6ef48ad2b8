#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/certificate_sum.hpp"
#include "core/double_double.hpp"
#include "core/part_proof.hpp"
#include "core/proof_grid.hpp"
#include "core/use_bounds.hpp"
#include "nda/proof.hpp"

// The frame of a proof: which arcs are worth using, which part each belongs to, and the sum of what
// the parts prove.  core/part_proof.cpp follows the tree of a part.

namespace nda {
namespace {

using core::CertificateSum;
using core::DoubleDouble;
using core::PartArcs;
using core::ProofFault;

constexpr std::uint32_t kNowhere = std::numeric_limits<std::uint32_t>::max();

// Divides the problem among the parts and adds up what they prove.
class ProofWalk {
 public:
  ProofWalk(const Problem& problem, const Proof& proof) : problem_(problem), proof_(proof) {}

  double bound() {
    check_frame();
    locate();
    divide();
    CertificateSum sum;
    double terms = 6 + static_cast<double>(proof_.parts.size());
    sum.enlarge(dropped_size_);
    terms += static_cast<double>(problem_.num_arcs());
    for (std::size_t p = 0; p < proof_.parts.size(); ++p) sum.add(p, part_bound(p));
    for (int k = 0; k < problem_.num_dimensions(); ++k) {
      const auto costs = problem_.singleton_costs(k);
      for (Index i = 1; i < costs.size(); ++i) {
        if (part_of_[at(k)][i] != kNowhere) continue;
        sum.add(i, costs[i]);
        ++terms;
      }
    }
    return sum.rounded_down(terms);
  }

 private:
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  void check_frame() const {
    if (problem_.is_many_to_one())
      throw ProofFault{"bounds on uses have no proofs: " + core::first_bounds(problem_)};
    if (!std::equal(proof_.sizes.begin(),
                    proof_.sizes.end(),
                    problem_.sizes().begin(),
                    problem_.sizes().end()))
      throw ProofFault{"the proof is of a problem of other sizes"};
    if (proof_.num_arcs != problem_.num_arcs())
      throw ProofFault{"the proof is of a problem with " + std::to_string(proof_.num_arcs) +
                       " arcs"};
    if (proof_.grid != 0) check_grid();
  }

  void check_grid() const {
    if (!(proof_.grid > 0) || !std::isfinite(proof_.grid))
      throw ProofFault{"the grid is not positive"};
    for_each_cost([&](double cost) {
      const double steps = std::nearbyint(cost / proof_.grid);
      if (std::abs(steps) > core::kMostGridSteps ||
          std::abs(std::fma(-steps, proof_.grid, cost)) > 0x1p-51 * std::abs(cost))
        throw ProofFault{"a cost is not a multiple of the grid"};
    });
  }

  template <typename Visit>
  void for_each_cost(Visit&& visit) const {
    for (const double cost : problem_.costs()) visit(cost);
    for (int k = 0; k < problem_.num_dimensions(); ++k) {
      for (const double cost : problem_.singleton_costs(k)) {
        if (cost < kInfinity) visit(cost);
      }
    }
  }

  // Where every index is: its part and its position there.
  void locate() {
    for (const Index size : problem_.sizes()) {
      part_of_.emplace_back(size + std::size_t{1}, kNowhere);
      position_.emplace_back(size + std::size_t{1}, kNowhere);
    }
    for (std::size_t p = 0; p < proof_.parts.size(); ++p) {
      const std::vector<ProofIndex>& indices = proof_.parts[p].indices;
      for (std::size_t n = 0; n < indices.size(); ++n) {
        const auto [k, i] = indices[n];
        if (k < 0 || k >= problem_.num_dimensions() || i == 0 || i > problem_.size(k))
          throw ProofFault{part_name(p) + "an index is out of range"};
        if (part_of_[at(k)][i] != kNowhere)
          throw ProofFault{part_name(p) + "an index is in two places"};
        part_of_[at(k)][i] = static_cast<std::uint32_t>(p);
        position_[at(k)][i] = static_cast<std::uint32_t>(n);
      }
    }
  }

  static std::string part_name(std::size_t p) { return "part " + std::to_string(p + 1) + ": "; }

  // An arc that costs no less than its singletons.
  bool worthless(std::size_t a) {
    DoubleDouble excess(problem_.costs()[a]);
    double size = std::abs(problem_.costs()[a]);
    for (int k = 0; k < problem_.num_dimensions(); ++k) {
      const Index i = problem_.indices(k)[a];
      if (i == 0) continue;
      const double alone = problem_.singleton_costs(k)[i];
      if (alone == kInfinity) return false;
      excess.add(-alone);
      size += std::abs(alone);
    }
    if (excess.negative()) return false;
    dropped_size_ += size;
    return true;
  }

  void divide() {
    arcs_.resize(proof_.parts.size());
    for (std::size_t a = 0; a < problem_.num_arcs(); ++a) {
      if (worthless(a)) continue;
      std::uint32_t part = kNowhere;
      for (int k = 0; k < problem_.num_dimensions(); ++k) {
        const Index i = problem_.indices(k)[a];
        if (i == 0) continue;
        const std::uint32_t here = part_of_[at(k)][i];
        if (here == kNowhere || (part != kNowhere && here != part))
          throw ProofFault{"arc " + std::to_string(a + 1) + " lies in no part"};
        part = here;
      }
      add(a, arcs_[part]);
    }
  }

  void add(std::size_t a, PartArcs& arcs) {
    arcs.cost.push_back(problem_.costs()[a]);
    arcs.number.push_back(static_cast<std::uint32_t>(a + 1));
    for (int k = 0; k < problem_.num_dimensions(); ++k) {
      const Index i = problem_.indices(k)[a];
      if (i != 0) arcs.positions.push_back(position_[at(k)][i]);
    }
    arcs.start.push_back(static_cast<std::uint32_t>(arcs.positions.size()));
  }

  double part_bound(std::size_t p) const {
    std::vector<double> singletons;
    for (const auto [k, i] : proof_.parts[p].indices)
      singletons.push_back(problem_.singleton_costs(k)[i]);
    try {
      return core::part_bound(arcs_[p], singletons, proof_.grid, proof_.parts[p].steps);
    } catch (const ProofFault& fault) {
      throw ProofFault{part_name(p) + fault.text};
    }
  }

  const Problem& problem_;
  const Proof& proof_;
  std::vector<std::vector<std::uint32_t>> part_of_;   // [k][i]
  std::vector<std::vector<std::uint32_t>> position_;  // [k][i]
  std::vector<PartArcs> arcs_;                        // by part
  double dropped_size_ = 0;
};

}  // namespace

ProofReport check_proof(const Problem& problem, const Proof& proof) {
  ProofReport report;
  try {
    report.lower_bound = ProofWalk(problem, proof).bound();
  } catch (const ProofFault& fault) {
    report.fault = fault.text;
  }
  return report;
}

}  // namespace nda
