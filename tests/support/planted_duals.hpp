#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "core/random.hpp"
#include "dual/concave_function.hpp"

/// Piecewise linear concave functions of the kind Lagrangian relaxation produces, with a maximum
/// that is known because it was planted (weak duality gives "at most", the planted point "at
/// least").
namespace nda::test {

/// q(u) = min over p of c_p + g_p'u, g_p = 1 - (how often primal point p uses each index):
/// integers.
///
/// Planted: pieces 0..K-1 are active at u* with the value q*, and their subgradients add up to 0,
/// so 0 is a supergradient at u*; every other piece lies above q* there.
class PlantedPolyhedron : public dual::ConcaveFunction {
 public:
  struct Size {
    std::size_t variables = 50;
    std::size_t active = 25;    ///< K
    std::size_t pieces = 2000;  ///< in all
  };

  PlantedPolyhedron(const Size& size, std::uint64_t seed) : n_(size.variables) {
    core::Random random(seed);
    std::vector<double> optimum(n_);
    for (double& u : optimum) u = -random.uniform(0, 10);
    maximum_ = -random.uniform(50, 150);
    add_active_pieces(size.active, random);
    while (subgradients_.size() < size.pieces * n_) {
      for (std::size_t i = 0; i < n_; ++i) {
        subgradients_.push_back(1 - static_cast<double>(random.below(3)));
      }
    }
    for (std::size_t p = 0; p < size.pieces; ++p) {
      const double slack = p < size.active ? 0 : random.uniform(0, 5 * std::sqrt(double(n_)));
      const double* g = subgradients_.data() + p * n_;
      constants_.push_back(maximum_ + slack - std::inner_product(g, g + n_, optimum.begin(), 0.0));
    }
  }

  std::size_t num_variables() const override { return n_; }
  double maximum() const { return maximum_; }

  double evaluate(std::span<const double> u, std::span<double> subgradient) override {
    std::size_t best = 0;
    double best_value = 0;
    for (std::size_t p = 0; p < constants_.size(); ++p) {
      const double* g = subgradients_.data() + p * n_;
      const double value = std::inner_product(u.begin(), u.end(), g, constants_[p]);
      if (p > 0 && value >= best_value) continue;
      best = p;
      best_value = value;
    }
    std::copy_n(subgradients_.data() + best * n_, n_, subgradient.begin());
    return best_value;
  }

 private:
  // Every index is used K times by the K points together, in a random distribution.
  void add_active_pieces(std::size_t count, core::Random& random) {
    subgradients_.assign(count * n_, 1.0);
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t use = 0; use < count; ++use) {
        subgradients_[static_cast<std::size_t>(random.below(count)) * n_ + i] -= 1;
      }
    }
  }

  std::size_t n_;
  double maximum_ = 0;
  std::vector<double> subgradients_;  // row p = g_p
  std::vector<double> constants_;
};

/// The dual of a set packing problem with `dimensions` index sets of `size` indices: every arc uses
/// one index of each, the first set is kept (one cheapest arc per index, or none), the others are
/// relaxed with u[k][i] <= 0 implied by the singletons, which cost nothing:
///
///     q(u) = sum over relaxed (k, i) of min(u[k][i], 0)
///          + sum over i_1 of min(0, min over its arcs of c_a - sum over k >= 2 of u[k][a_k]).
///
/// Planted: u*, v* <= 0 and a perfect solution of arcs with c_a = v*[a_1] + sum u*[k][a_k]; every
/// other arc costs more than that, `repeats` further perfect solutions do not.  Then q(u*) =
/// sum u* + sum v* = cost of the planted solution, so both are optimal.
class PlantedPacking : public dual::CoordinateFunction {
 public:
  struct Size {
    std::size_t dimensions = 4;
    std::size_t size = 30;
    std::size_t arcs_per_index = 40;  ///< of the first set
    std::size_t repeats = 1;
  };

  PlantedPacking(const Size& size, std::uint64_t seed)
      : relaxed_(size.dimensions - 1), size_(size.size) {
    core::Random random(seed);
    std::vector<double> optimum(num_variables());
    for (double& u : optimum) u = -random.uniform(0, 10);
    arcs_.resize(size_);
    for (std::size_t s = 0; s <= size.repeats; ++s) add_perfect_solution(random);
    for (Block& block : arcs_) {
      const double kept = -random.uniform(0, 10);
      while (block.costs.size() < size.arcs_per_index) add_arc(block, random);
      for (std::size_t a = 0; a < block.costs.size(); ++a) {
        for (std::size_t k = 0; k < relaxed_; ++k)
          block.costs[a] += optimum[block.variable(a, k, relaxed_)];
        block.costs[a] += kept;
      }
      maximum_ += kept;
    }
    maximum_ = std::accumulate(optimum.begin(), optimum.end(), maximum_);
  }

  std::size_t num_variables() const override { return relaxed_ * size_; }
  double maximum() const { return maximum_; }

  double evaluate(std::span<const double> u, std::span<double> subgradient) override {
    double value = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      value += std::min(u[i], 0.0);
      subgradient[i] = u[i] < 0 ? 1 : 0;
    }
    for (const Block& block : arcs_) {
      std::size_t best = 0;
      double best_cost = 0;
      for (std::size_t a = 0; a < block.costs.size(); ++a) {
        const double reduced = reduced_cost(block, a, u);
        if (reduced >= best_cost) continue;
        best = a;
        best_cost = reduced;
      }
      value += best_cost;
      for (std::size_t k = 0; k < relaxed_ && best_cost < 0; ++k) {
        subgradient[block.variable(best, k, relaxed_)] -= 1;
      }
    }
    return value;
  }

  /// One variable is a block; q along it is piecewise linear, its maximum found by trying the
  /// kinks.
  std::size_t num_blocks() const override { return num_variables(); }
  double ascend(std::size_t block, std::span<double> u) override {
    std::vector<double> unused(u.size());
    const double before = evaluate(u, unused);
    double best = u[block];
    double best_value = before;
    for (const double kink : kinks(block, u)) {
      u[block] = kink;
      const double value = evaluate(u, unused);
      if (value > best_value) {
        best_value = value;
        best = kink;
      }
    }
    u[block] = best;
    return best_value - before;
  }

 private:
  struct Block {
    std::vector<double> costs;
    std::vector<std::size_t> variables;  // of arc a: relaxed numbers from a * relaxed
    std::size_t variable(std::size_t a, std::size_t k, std::size_t relaxed) const {
      return variables[a * relaxed + k];
    }
  };

  double reduced_cost(const Block& block, std::size_t a, std::span<const double> u) const {
    double cost = block.costs[a];
    for (std::size_t k = 0; k < relaxed_; ++k) cost -= u[block.variable(a, k, relaxed_)];
    return cost;
  }

  void add_perfect_solution(core::Random& random) {
    for (Block& block : arcs_) block.costs.push_back(0);
    for (std::size_t k = 0; k < relaxed_; ++k) {
      std::vector<std::size_t> order(size_);
      std::iota(order.begin(), order.end(), k * size_);
      core::shuffle(order, random);
      for (std::size_t i = 0; i < size_; ++i) {
        Block& block = arcs_[i];
        block.variables.resize(block.costs.size() * relaxed_);
        block.variables[(block.costs.size() - 1) * relaxed_ + k] = order[i];
      }
    }
  }

  void add_arc(Block& block, core::Random& random) const {
    block.costs.push_back(-3 * std::log(1 - random.uniform()));
    for (std::size_t k = 0; k < relaxed_; ++k) {
      block.variables.push_back(k * size_ + static_cast<std::size_t>(random.below(size_)));
    }
  }

  // Where an arc with the variable begins to be chosen in its block, or 0.
  std::vector<double> kinks(std::size_t variable, std::span<const double> u) const {
    std::vector<double> result = {0.0};
    for (const Block& block : arcs_) {
      double other = 0;
      for (std::size_t a = 0; a < block.costs.size(); ++a) {
        if (!uses(block, a, variable)) other = std::min(other, reduced_cost(block, a, u));
      }
      for (std::size_t a = 0; a < block.costs.size(); ++a) {
        if (uses(block, a, variable)) {
          result.push_back(reduced_cost(block, a, u) + u[variable] - other);
        }
      }
    }
    return result;
  }

  bool uses(const Block& block, std::size_t a, std::size_t variable) const {
    const auto* first = block.variables.data() + a * relaxed_;
    return std::find(first, first + relaxed_, variable) != first + relaxed_;
  }

  std::size_t relaxed_;
  std::size_t size_;
  double maximum_ = 0;
  std::vector<Block> arcs_;
};

}  // namespace nda::test
