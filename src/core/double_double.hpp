#pragma once

namespace nda::core {

/// A sum kept as an unevaluated pair high + low, about 106 bits (Dekker 1971, Knuth TwoSum).
/// Needs strict IEEE arithmetic: no -ffast-math.
class DoubleDouble {
 public:
  DoubleDouble() = default;
  explicit DoubleDouble(double value) : high_(value) {}

  /// Adds x; relative error of the running sum below 2^-104 per addition.
  void add(double x) {
    const double sum = high_ + x;
    const double part = sum - high_;
    const double error = (high_ - (sum - part)) + (x - part);
    const double low = low_ + error;
    high_ = sum + low;
    low_ = low - (high_ - sum);
  }

  double high() const { return high_; }
  double low() const { return low_; }
  bool negative() const { return high_ < 0 || (high_ == 0 && low_ < 0); }

 private:
  double high_ = 0;
  double low_ = 0;
};

}  // namespace nda::core
