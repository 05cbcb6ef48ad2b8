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
  /// Both spans have num_variables() entries; u is finite, and so must be q(u) and g.
  virtual double evaluate(std::span<const double> u, std::span<double> subgradient) = 0;
};

/// A concave function whose variables fall into blocks over each of which it is easy to maximise.
class CoordinateFunction : public ConcaveFunction {
 public:
  /// Number of blocks, >= 1 if there is a variable.
  virtual std::size_t num_blocks() const = 0;

  /// Moves the variables of one block, and no others, to where q is largest with the others fixed
  /// (or at least not smaller), and returns the increase of q, >= 0.
  virtual double ascend(std::size_t block, std::span<double> u) = 0;
};

}  // namespace nda::dual
