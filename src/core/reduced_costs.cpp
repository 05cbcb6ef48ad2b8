#include "core/reduced_costs.hpp"

#include "core/loads.hpp"

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
  std::size_t n = 0;
  for (; n + 1 < r.size(); n += 2) {
    double sum = from[n];
    double next = from[n + 1];
    for (const Term& t : term) {
      const auto [i, j] = two_indices(t.index + n);
      sum -= t.u[i];
      next -= t.u[j];
    }
    r[n] = sum;
    r[n + 1] = next;
  }
  if (n == r.size()) return;
  double sum = from[n];
  for (const Term& t : term) sum -= t.u[t.index[n]];
  r[n] = sum;
}

using Subtract = void (*)(const Term*, const double*, std::size_t, std::span<double>);
constexpr std::array<Subtract, kMostTerms + 1> kSubtract = {
    subtract<0>, subtract<1>, subtract<2>, subtract<3>, subtract<4>, subtract<5>};

// In rounds of equal size, so that none has just one dimension.
void subtract_all(std::span<const Term> terms,
                  const double* costs,
                  std::size_t first,
                  std::span<double> r) {
  const double* from = costs + first;
  std::size_t rounds = std::max<std::size_t>(1, (terms.size() + kMostTerms - 1) / kMostTerms);
  for (; rounds > 0; --rounds) {
    const std::size_t count = (terms.size() + rounds - 1) / rounds;
    kSubtract[count](terms.data(), from, first, r);
    terms = terms.subspan(count);
    from = r.data();
  }
}

}  // namespace

void reduced_costs(const Component& component,
                   std::span<const double> u,
                   ArcId first,
                   std::span<double> r,
                   int from_dimension) {
  std::array<Term, kMaxDimensions> terms;
  const std::size_t skipped = static_cast<std::size_t>(from_dimension);
  const std::size_t num_terms = component.sizes.size() - skipped;
  for (std::size_t k = 0; k < num_terms; ++k) {
    terms[k] = {component.indices[skipped + k].data(), u.data() + component.offset[skipped + k]};
  }
  for (std::size_t done = 0; done < r.size(); done += kReducedBlock) {
    const auto block = r.subspan(done, std::min(kReducedBlock, r.size() - done));
    subtract_all(std::span(terms).first(num_terms), component.costs.data(), first + done, block);
  }
}

}  // namespace nda::core
