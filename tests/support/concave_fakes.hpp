#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "dual/concave_function.hpp"

/// Small concave functions for tests of the maximisers, and wrappers that change one thing.
namespace nda::test {

/// q(u) = min over the rows of constant[i] + slope[i]'u.
class Planes : public dual::ConcaveFunction {
 public:
  Planes(std::vector<double> constants, std::vector<std::vector<double>> slopes)
      : constants_(std::move(constants)), slopes_(std::move(slopes)) {}
  std::size_t num_variables() const override { return slopes_[0].size(); }
  double evaluate(std::span<const double> u, std::span<double> subgradient) override {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < slopes_.size(); ++i) {
      const double value =
          std::inner_product(u.begin(), u.end(), slopes_[i].begin(), constants_[i]);
      if (value >= best) continue;
      best = value;
      std::copy(slopes_[i].begin(), slopes_[i].end(), subgradient.begin());
    }
    return best;
  }

 private:
  std::vector<double> constants_;
  std::vector<std::vector<double>> slopes_;
};

/// q(u) = -sum weight_i |u_i - peak_i|; each variable is a block, q is separable.
class Tents : public dual::CoordinateFunction {
 public:
  explicit Tents(std::vector<double> peaks) : Tents(peaks, std::vector<double>(peaks.size(), 1)) {}
  Tents(std::vector<double> peaks, std::vector<double> weights)
      : peaks_(std::move(peaks)), weights_(std::move(weights)) {}
  std::size_t num_variables() const override { return peaks_.size(); }
  double evaluate(std::span<const double> u, std::span<double> subgradient) override {
    double value = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      value -= weights_[i] * std::abs(u[i] - peaks_[i]);
      subgradient[i] = u[i] == peaks_[i] ? 0 : (u[i] < peaks_[i] ? weights_[i] : -weights_[i]);
    }
    return value;
  }
  std::size_t num_blocks() const override { return peaks_.size(); }
  double ascend(std::size_t block, std::span<double> u) override {
    const double increase = weights_[block] * std::abs(u[block] - peaks_[block]);
    u[block] = peaks_[block];
    return increase;
  }

 private:
  std::vector<double> peaks_;
  std::vector<double> weights_;
};

/// factor * q(u / stretch) + offset, and counts how often it is asked.
class Scaled : public dual::ConcaveFunction {
 public:
  Scaled(dual::ConcaveFunction& inner, double factor, double stretch, double offset)
      : inner_(inner), factor_(factor), stretch_(stretch), offset_(offset) {}
  std::size_t num_variables() const override { return inner_.num_variables(); }
  double evaluate(std::span<const double> u, std::span<double> subgradient) override {
    ++calls_;
    std::vector<double> inner_point(u.begin(), u.end());
    for (double& x : inner_point) x /= stretch_;
    const double value = inner_.evaluate(inner_point, subgradient);
    for (double& g : subgradient) g *= factor_ / stretch_;
    return factor_ * value + offset_;
  }
  int calls() const { return calls_; }

 private:
  dual::ConcaveFunction& inner_;
  double factor_;
  double stretch_;
  double offset_;
  int calls_ = 0;
};

}  // namespace nda::test
