#pragma once

#include <cstddef>
#include <span>

namespace nda::dual {

/// A concave function q of n variables, perhaps not differentiable, that can be evaluated.
/// The maximisers of this folder know nothing else of the problem behind it.
class ConcaveFunction {
 public:
  virtual ~ConcaveFunction() = default;

  /// n.
  virtual std::size_t num_variables() const = 0;

  /// Returns q(u) and writes one supergradient g: q(w) <= q(u) + g'(w - u) for all w.
  /// Both spans have num_variables() entries; u is finite.
  virtual double evaluate(std::span<const double> u, std::span<double> subgradient) = 0;
};

}  // namespace nda::dual
