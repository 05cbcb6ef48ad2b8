#include "core/reduced_costs.hpp"

// Every pass over all arcs computes these sums, so they are computed in one place, block by block:
// columns are read as streams, multipliers from cache, and what the caller does with the sums comes
// after, in a loop of its own.  With the number of dimensions fixed at compile time there is no
// inner loop; up to kMostTerms columns and multipliers have a register each for their address, and
// more dimensions are subtracted in several rounds.
//
// bench/roofline_benchmark.cpp measures this against what the machine can load, and also what was
// left out: gather instructions lose, and wider registers win nothing, as the loads of single
// multipliers are the limit (docs/benchmarks/roofline.md).

namespace nda::core {
namespace {

constexpr std::size_t kMostTerms = 5;

// One dimension: the index of every arc, the multiplier of every index.
struct Term {
  const Index* index;
  const double* u;
};

// r[n] = from[n] - the multipliers of `kTerms` dimensions; r may be `from`.
template <std::size_t kTerms>
void subtract(const Term* terms, const double* from, std::size_t first, std::span<double> r) {
  std::array<Term, kTerms> term;
  for (std::size_t k = 0; k < kTerms; ++k) term[k] = {terms[k].index + first, terms[k].u};
  for (std::size_t n = 0; n < r.size(); ++n) {
    double sum = from[n];
    for (const Term& t : term) sum -= t.u[t.index[n]];
    r[n] = sum;
  }
}

using Subtract = void (*)(const Term*, const double*, std::size_t, std::span<double>);
constexpr std::array<Subtract, kMostTerms + 1> kSubtract = {
    subtract<0>, subtract<1>, subtract<2>, subtract<3>, subtract<4>, subtract<5>};

}  // namespace

void reduced_costs(const Component& component,
                   std::span<const double> u,
                   ArcId first,
                   std::span<double> r,
                   int from_dimension) {
  std::array<Term, kMaxDimensions> terms;
  const std::size_t skipped = static_cast<std::size_t>(from_dimension);
  std::size_t left = component.sizes.size() - skipped;
  for (std::size_t k = 0; k < left; ++k) {
    terms[k] = {component.indices[skipped + k].data(), u.data() + component.offset[skipped + k]};
  }
  const Term* next = terms.data();
  const double* from = component.costs.data() + first;
  // Rounds of equal size, so that none has just one dimension.
  std::size_t rounds = std::max<std::size_t>(1, (left + kMostTerms - 1) / kMostTerms);
  for (; rounds > 0; --rounds) {
    const std::size_t count = (left + rounds - 1) / rounds;
    kSubtract[count](next, from, first, r);
    next += count;
    left -= count;
    from = r.data();
  }
}

}  // namespace nda::core
