#include "core/certificate.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/certificate_sum.hpp"
#include "core/min_max.hpp"
#include "nda/check.hpp"

// The certificate is a sum in double-double, rounded downwards by a bound on all its rounding
// errors (core/certificate_sum.hpp).  Most arcs have a reduced cost that is surely positive, which
// plain arithmetic sees; the others are added up exactly, many at a time.

namespace nda {

namespace core {

std::string multipliers_fault(const Problem& problem,
                              const std::vector<std::vector<double>>& multipliers) {
  if (multipliers.size() != static_cast<std::size_t>(problem.num_dimensions())) {
    return "multipliers of " + std::to_string(multipliers.size()) +
           " dimensions, the problem has " + std::to_string(problem.num_dimensions());
  }
  for (std::size_t k = 0; k < multipliers.size(); ++k) {
    const std::string place = "dimension " + std::to_string(k + 1);
    if (multipliers[k].size() != problem.sizes()[k]) {
      return place + " has " + std::to_string(multipliers[k].size()) + " multipliers, not " +
             std::to_string(problem.sizes()[k]);
    }
    for (const double u : multipliers[k]) {
      if (!std::isfinite(u)) return "a multiplier of " + place + " is not finite";
    }
  }
  return {};
}

}  // namespace core

namespace {

// Sums c - sum of u over many arcs at a time, in double-double, which fills the vector units.
class ReducedCosts {
 public:
  static constexpr std::size_t kMost = 128;  // arcs at a time

  ReducedCosts(const Problem& problem, const std::vector<std::vector<double>>& multipliers)
      : costs_(problem.costs().data()), num_(multipliers.size()) {
    for (std::size_t k = 0; k < num_; ++k) {
      columns_[k] = problem.indices(static_cast<int>(k)).data();
      table_[k].reserve(multipliers[k].size() + 1);
      table_[k].push_back(0.0);
      table_[k].insert(table_[k].end(), multipliers[k].begin(), multipliers[k].end());
      multipliers_[k] = table_[k].data();
      double most = 0;
      for (const double u : multipliers[k]) most = core::max_of(most, std::abs(u));
      most_size_ += most;
    }
  }

  // Adds the negative ones of the arcs first, first + 1, ..., kMost of them at most.
  void add_negative_to(core::CertificateSum& sum, std::size_t first, std::size_t count) {
    find_doubtful(first, count);
    if (count_ > 0) add_negative_to(sum);
  }

 private:
  double multiplier(std::size_t k, std::size_t a) const { return multipliers_[k][columns_[k][a]]; }

  // Those that plain arithmetic does not see to be positive, whose n rounding errors are below
  // 2^-53 times the sum of all terms in size each.
  void find_doubtful(std::size_t first, std::size_t count) {
    const double* from = costs_ + first;
    std::size_t k = 0;
    for (; k + 4 <= num_; k += 4) from = subtract_rounded<4>(from, k, first, count);
    if (num_ - k >= 2) {
      from = subtract_rounded<2>(from, k, first, count);
      k += 2;
    }
    if (k < num_) subtract_rounded<1>(from, k, first, count);
    const double share = static_cast<double>(num_ + 1) * 0x1p-51;
    count_ = 0;
    for (std::size_t n = 0; n < count; ++n) {  // without a jump
      arcs_[count_] = first + n;
      count_ += !(high_[n] > share * (std::abs(costs_[first + n]) + most_size_));
    }
  }

  // Writes high_ = `from` - the multipliers of some dimensions from k on: several at a time, as
  // every pass stores and loads.
  template <std::size_t kDimensions>
  const double* subtract_rounded(const double* from,
                                 std::size_t k,
                                 std::size_t first,
                                 std::size_t count) {
    std::array<const Index*, kDimensions> index;
    std::array<const double*, kDimensions> u;
    for (std::size_t d = 0; d < kDimensions; ++d) {
      index[d] = columns_[k + d] + first;
      u[d] = multipliers_[k + d];
    }
    double* const high = high_.data();
    for (std::size_t n = 0; n < count; ++n) {
      double sum = from[n];
      for (std::size_t d = 0; d < kDimensions; ++d) sum -= u[d][index[d][n]];
      high[n] = sum;
    }
    return high;
  }

  void add_negative_to(core::CertificateSum& sum) {
    for (std::size_t n = 0; n < count_; ++n) {
      high_[n] = costs_[arcs_[n]];
      low_[n] = 0;
      size_[n] = std::abs(high_[n]);
    }
    for (std::size_t k = 0; k < num_; ++k) subtract_multipliers(k);
    for (std::size_t n = 0; n < count_; ++n) {
      const bool negative = high_[n] < 0 || (high_[n] == 0 && low_[n] < 0);
      // Where the sum may have overflown its sign says nothing.
      if (!negative && std::isfinite(size_[n])) continue;
      sum.add(n, high_[n]);
      sum.add(n, low_[n]);
      sum.enlarge(size_[n]);
    }
  }

  // DoubleDouble::add for all at once.
  void subtract_multipliers(std::size_t k) {
    std::array<double, kMost> terms;
    for (std::size_t n = 0; n < count_; ++n) terms[n] = -multiplier(k, arcs_[n]);
    for (std::size_t n = 0; n < count_; ++n) {
      const double x = terms[n];
      const double sum = high_[n] + x;
      const double part = sum - high_[n];
      const double low = low_[n] + ((high_[n] - (sum - part)) + (x - part));
      high_[n] = sum + low;
      low_[n] = low - (high_[n] - sum);
      size_[n] += std::abs(x);
    }
  }

  const double* costs_;
  const std::size_t num_;
  std::array<const Index*, kMaxDimensions> columns_{};
  std::array<const double*, kMaxDimensions> multipliers_{};  // by index, 0 for the dummy
  std::array<std::vector<double>, kMaxDimensions> table_;
  double most_size_ = 0;  // of the multipliers of one arc, added up
  std::size_t count_ = 0;
  std::array<std::size_t, kMost> arcs_;  // that many, which may be negative
  std::array<double, kMost> high_;
  std::array<double, kMost> low_;
  std::array<double, kMost> size_;
};

// Adds times * value, of which fma() gives the part that a double cannot hold.
void add_product(core::CertificateSum& sum, std::size_t position, double times, double value) {
  const double product = times * value;
  sum.add(position, product);
  if (times != 1) sum.add(position, std::fma(times, value, -product));
}

}  // namespace

double certificate_bound(const Problem& problem,
                         const std::vector<std::vector<double>>& multipliers) {
  const std::string fault = core::multipliers_fault(problem, multipliers);
  if (!fault.empty()) throw InputError(fault);
  core::CertificateSum sum;
  const std::size_t n = multipliers.size();
  for (std::size_t k = 0; k < n; ++k) {
    const auto singletons = problem.singleton_costs(static_cast<int>(k));
    for (Index i = 1; i < singletons.size(); ++i) {
      const double least = std::min(singletons[i], multipliers[k][i - 1]);
      const UseBounds bounds = problem.use_bounds(static_cast<int>(k), i);
      if (least < 0 && bounds.hi == UseBounds::kUnlimited) return -kInfinity;
      add_product(sum, i, least < 0 ? bounds.hi : bounds.lo, least);
    }
  }
  ReducedCosts reduced(problem, multipliers);
  for (std::size_t a = 0; a < problem.num_arcs(); a += ReducedCosts::kMost)
    reduced.add_negative_to(sum, a, std::min(ReducedCosts::kMost, problem.num_arcs() - a));
  return sum.rounded_down(
      static_cast<double>(problem.num_arcs() * (n + 2) + 2 * problem.num_indices() + 6));
}

}  // namespace nda
