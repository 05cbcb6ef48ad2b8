#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dual/concave_function.hpp"
#include "support/tr48_data.hpp"

/// Standard test functions of nonsmooth optimisation: convex f to be minimised, used here as the
/// concave q = -f.  Formulas, start points and minima as in Luksan & Vlcek, Test problems for
/// nonsmooth unconstrained and linearly constrained optimization, report 798, Prague 2000 (problem
/// number in brackets), and Haarala, Miettinen & Makela, Optim. Methods Softw. 19 (2004) for the
/// chained ones; minima that are not round numbers with two or three digits more than published.
/// Left out: El-Attar, Crescent, Gill and the like, which are not convex.
namespace nda::test {

using Span = std::span<const double>;
using MutableSpan = std::span<double>;

/// Returns f(x) and writes a subgradient of f.
using ConvexFormula = std::function<double(Span x, MutableSpan g)>;

/// q = -f.
class NegatedFunction : public dual::ConcaveFunction {
 public:
  NegatedFunction(std::size_t n, ConvexFormula f) : n_(n), f_(std::move(f)) {}
  std::size_t num_variables() const override { return n_; }
  double evaluate(Span u, MutableSpan subgradient) override {
    const double value = f_(u, subgradient);
    for (double& g : subgradient) g = -g;
    return -value;
  }

 private:
  std::size_t n_;
  ConvexFormula f_;
};

/// A function to minimise.
struct NonsmoothProblem {
  std::string name;
  std::vector<double> start;
  double minimum = 0;
  ConvexFormula formula;

  std::size_t size() const { return start.size(); }
  NegatedFunction negated() const { return NegatedFunction(start.size(), formula); }
};

inline void PrintTo(const NonsmoothProblem& problem, std::ostream* out) {
  *out << problem.name;
}

/// Keeps the largest of some smooth pieces and writes its gradient.
class MaxOfPieces {
 public:
  explicit MaxOfPieces(MutableSpan g) : g_(g) {}
  template <class Gradient>
  void add(double value, Gradient write_gradient) {
    if (any_ && value <= value_) return;
    any_ = true;
    value_ = value;
    write_gradient(g_);
  }
  double value() const { return value_; }

 private:
  MutableSpan g_;
  double value_ = 0;
  bool any_ = false;
};

inline void set(MutableSpan g, std::initializer_list<double> values) {
  std::copy(values.begin(), values.end(), g.begin());
}

/// [3] max(x^2 + y^4, (2 - x)^2 + (2 - y)^2, 2 exp(y - x)).
inline NonsmoothProblem cb2() {
  return {"CB2", {1, -0.1}, 1.9522244939, [](Span x, MutableSpan g) {
            MaxOfPieces f(g);
            const double e = 2 * std::exp(x[1] - x[0]);
            f.add(x[0] * x[0] + std::pow(x[1], 4), [&](MutableSpan d) {
              set(d, {2 * x[0], 4 * std::pow(x[1], 3)});
            });
            f.add(std::pow(2 - x[0], 2) + std::pow(2 - x[1], 2), [&](MutableSpan d) {
              set(d, {2 * (x[0] - 2), 2 * (x[1] - 2)});
            });
            f.add(e, [&](MutableSpan d) { set(d, {-e, e}); });
            return f.value();
          }};
}

/// [4] max(x^4 + y^2, (2 - x)^2 + (2 - y)^2, 2 exp(y - x)); minimum 2 at (1, 1).
inline NonsmoothProblem cb3() {
  return {"CB3", {2, 2}, 2, [](Span x, MutableSpan g) {
            MaxOfPieces f(g);
            const double e = 2 * std::exp(x[1] - x[0]);
            f.add(std::pow(x[0], 4) + x[1] * x[1], [&](MutableSpan d) {
              set(d, {4 * std::pow(x[0], 3), 2 * x[1]});
            });
            f.add(std::pow(2 - x[0], 2) + std::pow(2 - x[1], 2), [&](MutableSpan d) {
              set(d, {2 * (x[0] - 2), 2 * (x[1] - 2)});
            });
            f.add(e, [&](MutableSpan d) { set(d, {-e, e}); });
            return f.value();
          }};
}

/// [5] max(5x + y, -5x + y, x^2 + y^2 + 4y); minimum -3 at (0, -3).
inline NonsmoothProblem dem() {
  return {"DEM", {1, 1}, -3, [](Span x, MutableSpan g) {
            MaxOfPieces f(g);
            f.add(5 * x[0] + x[1], [](MutableSpan d) { set(d, {5, 1}); });
            f.add(-5 * x[0] + x[1], [](MutableSpan d) { set(d, {-5, 1}); });
            f.add(x[0] * x[0] + x[1] * x[1] + 4 * x[1], [&](MutableSpan d) {
              set(d, {2 * x[0], 2 * x[1] + 4});
            });
            return f.value();
          }};
}

/// [6] r = x^2 + y^2; max(r, r + 10 (4 - 4x - y), r + 10 (6 - x - 2y)); minimum 7.2 at (1.2, 2.4).
inline NonsmoothProblem ql() {
  return {"QL", {-1, 5}, 7.2, [](Span x, MutableSpan g) {
            MaxOfPieces f(g);
            const double r = x[0] * x[0] + x[1] * x[1];
            f.add(r, [&](MutableSpan d) { set(d, {2 * x[0], 2 * x[1]}); });
            f.add(r + 10 * (4 - 4 * x[0] - x[1]), [&](MutableSpan d) {
              set(d, {2 * x[0] - 40, 2 * x[1] - 10});
            });
            f.add(r + 10 * (6 - x[0] - 2 * x[1]), [&](MutableSpan d) {
              set(d, {2 * x[0] - 10, 2 * x[1] - 20});
            });
            return f.value();
          }};
}

/// [7] max(-x - y, -x - y + x^2 + y^2 - 1); minimum -sqrt 2 at (1, 1) / sqrt 2.
inline NonsmoothProblem lq() {
  return {"LQ", {-0.5, -0.5}, -std::sqrt(2.0), [](Span x, MutableSpan g) {
            MaxOfPieces f(g);
            f.add(-x[0] - x[1], [](MutableSpan d) { set(d, {-1, -1}); });
            f.add(-x[0] - x[1] + x[0] * x[0] + x[1] * x[1] - 1, [&](MutableSpan d) {
              set(d, {2 * x[0] - 1, 2 * x[1] - 1});
            });
            return f.value();
          }};
}

/// [8] -x + 20 max(0, x^2 + y^2 - 1); minimum -1 at (1, 0).
inline NonsmoothProblem mifflin1() {
  return {"Mifflin1", {0.8, 0.6}, -1, [](Span x, MutableSpan g) {
            const double r = x[0] * x[0] + x[1] * x[1] - 1;
            const double slope = r > 0 ? 20 : 0;
            set(g, {-1 + 2 * slope * x[0], 2 * slope * x[1]});
            return -x[0] + slope * r;
          }};
}

/// [9] r = x^2 + y^2 - 1; -x + 2 r + 1.75 |r|; minimum -1 at (1, 0).  Convex: an increasing convex
/// function of the convex r.
inline NonsmoothProblem mifflin2() {
  return {"Mifflin2", {-1, -1}, -1, [](Span x, MutableSpan g) {
            const double r = x[0] * x[0] + x[1] * x[1] - 1;
            const double slope = r > 0 ? 3.75 : 0.25;
            set(g, {-1 + 2 * slope * x[0], 2 * slope * x[1]});
            return -x[0] + slope * r;
          }};
}

/// [10] 5 sqrt(9 x^2 + 16 y^2) if x > |y|; 9x + 16 |y| if 0 < x <= |y|; 9x + 16 |y| - x^9 if x <=
/// 0. Minimum -8 at (-1, 0); steepest descent with exact line search stops at 0.
inline NonsmoothProblem wolfe() {
  return {"Wolfe", {3, 2}, -8, [](Span x, MutableSpan g) {
            const double sign = x[1] < 0 ? -1 : 1;
            if (x[0] > std::abs(x[1])) {
              const double root = std::sqrt(9 * x[0] * x[0] + 16 * x[1] * x[1]);
              set(g, {45 * x[0] / root, 80 * x[1] / root});
              return 5 * root;
            }
            const double power = x[0] > 0 ? 0 : std::pow(x[0], 8);
            set(g, {9 - 9 * power, 16 * sign});
            return 9 * x[0] + 16 * std::abs(x[1]) - power * x[0];
          }};
}

/// [11] Rosen & Suzuki's program by an exact penalty: f1 + 10 max(0, f2, f3, f4), with
/// f1 = a^2 + b^2 + 2c^2 + d^2 - 5a - 5b - 21c + 7d,   f2 = a^2 + b^2 + c^2 + d^2 + a - b + c - d -
/// 8, f3 = a^2 + 2b^2 + c^2 + 2d^2 - a - d - 10,          f4 = a^2 + b^2 + c^2 + 2a - b - d - 5.
/// Minimum -44 at (0, 1, 2, -1).
inline NonsmoothProblem rosen_suzuki() {
  return {"Rosen-Suzuki", {0, 0, 0, 0}, -44, [](Span x, MutableSpan g) {
            const auto [a, b, c, d] = std::array{x[0], x[1], x[2], x[3]};
            MaxOfPieces f(g);
            f.add(0, [](MutableSpan p) { set(p, {0, 0, 0, 0}); });
            f.add(a * a + b * b + c * c + d * d + a - b + c - d - 8, [&](MutableSpan p) {
              set(p, {2 * x[0] + 1, 2 * x[1] - 1, 2 * x[2] + 1, 2 * x[3] - 1});
            });
            f.add(a * a + 2 * b * b + c * c + 2 * d * d - a - d - 10, [&](MutableSpan p) {
              set(p, {2 * x[0] - 1, 4 * x[1], 2 * x[2], 4 * x[3] - 1});
            });
            f.add(a * a + b * b + c * c + 2 * a - b - d - 5, [&](MutableSpan p) {
              set(p, {2 * x[0] + 2, 2 * x[1] - 1, 2 * x[2], -1});
            });
            set(g,
                {10 * g[0] + 2 * a - 5,
                 10 * g[1] + 2 * b - 5,
                 10 * g[2] + 4 * c - 21,
                 10 * g[3] + 2 * d + 7});
            return a * a + b * b + 2 * c * c + d * d - 5 * (a + b) - 21 * c + 7 * d +
                   10 * f.value();
          }};
}

/// [12] max over i of b_i sum_j (x_j - a_ij)^2.
inline NonsmoothProblem shor() {
  static constexpr double a[10][5] = {{0, 0, 0, 0, 0},
                                      {2, 1, 1, 1, 3},
                                      {1, 2, 1, 1, 2},
                                      {1, 4, 1, 2, 2},
                                      {3, 2, 1, 0, 1},
                                      {0, 2, 1, 0, 1},
                                      {1, 1, 1, 1, 1},
                                      {1, 0, 1, 2, 1},
                                      {0, 0, 2, 1, 0},
                                      {1, 1, 2, 0, 0}};
  static constexpr double b[10] = {1, 5, 10, 2, 4, 3, 1.7, 2.5, 6, 3.5};
  return {"Shor", {0, 0, 0, 0, 1}, 22.600162096, [](Span x, MutableSpan g) {
            MaxOfPieces f(g);
            for (int i = 0; i < 10; ++i) {
              double sum = 0;
              for (std::size_t j = 0; j < 5; ++j) sum += std::pow(x[j] - a[i][j], 2);
              f.add(b[i] * sum, [&](MutableSpan d) {
                for (std::size_t j = 0; j < 5; ++j) d[j] = 2 * b[i] * (x[j] - a[i][j]);
              });
            }
            return f.value();
          }};
}

/// [13] Colville's first program by an exact penalty:
/// sum d_j x_j^3 + x'Cx + e'x + 50 max(0, max over i of b_i - sum_j a_ij x_j).
/// x_j^3 is replaced by max(0, x_j)^3, which makes it convex and keeps the minimum, where x > 0.
inline NonsmoothProblem colville1() {
  static constexpr double a[10][5] = {{-16, 2, 0, 1, 0},
                                      {0, -2, 0, 4, 2},
                                      {-3.5, 0, 2, 0, 0},
                                      {0, -2, 0, -4, -1},
                                      {0, -9, -2, 1, -2.8},
                                      {2, 0, -4, 0, 0},
                                      {-1, -1, -1, -1, -1},
                                      {-1, -2, -3, -2, -1},
                                      {1, 2, 3, 4, 5},
                                      {1, 1, 1, 1, 1}};
  static constexpr double b[10] = {-40, -2, -0.25, -4, -4, -1, -40, -60, 5, 1};
  static constexpr double c[5][5] = {{30, -20, -10, 32, -10},
                                     {-20, 39, -6, -31, 32},
                                     {-10, -6, 10, -6, -10},
                                     {32, -31, -6, 39, -20},
                                     {-10, 32, -10, -20, 30}};
  static constexpr double d[5] = {4, 8, 10, 6, 2};
  static constexpr double e[5] = {-15, -27, -36, -18, -12};
  return {"Colville1", {0, 0, 0, 0, 1}, -32.348678966, [](Span x, MutableSpan g) {
            MaxOfPieces f(g);
            f.add(0, [](MutableSpan p) { set(p, {0, 0, 0, 0, 0}); });
            for (int i = 0; i < 10; ++i) {
              double rest = b[i];
              for (std::size_t j = 0; j < 5; ++j) rest -= a[i][j] * x[j];
              f.add(50 * rest, [&](MutableSpan p) {
                for (std::size_t j = 0; j < 5; ++j) p[j] = -50 * a[i][j];
              });
            }
            double value = f.value();
            for (std::size_t j = 0; j < 5; ++j) {
              const double plus = std::max(0.0, x[j]);
              double product = 0;
              for (std::size_t i = 0; i < 5; ++i) product += c[i][j] * x[i];
              value += d[j] * plus * plus * plus + (product + e[j]) * x[j];
              g[j] += 3 * d[j] * plus * plus + 2 * product + e[j];
            }
            return value;
          }};
}

/// [16] max over k = 1..5 of x'A_k x - b_k'x, with A_k(i, j) = exp(i/j) cos(ij) sin k for i < j,
/// symmetric, A_k(i, i) = |sin k| i/10 + sum over j != i of |A_k(i, j)|, b_k(i) = exp(i/k) sin(ik).
inline NonsmoothProblem maxquad() {
  const auto entry = [](int i, int j, int k) {
    const double low = std::min(i, j);
    const double high = std::max(i, j);
    return std::exp(low / high) * std::cos(low * high) * std::sin(k);
  };
  std::vector<double> a(500);
  std::vector<double> b(50);
  for (int k = 1; k <= 5; ++k) {
    for (int i = 1; i <= 10; ++i) {
      const auto row = static_cast<std::size_t>(100 * (k - 1) + 10 * (i - 1));
      double sum = std::abs(std::sin(k)) * i / 10;
      for (int j = 1; j <= 10; ++j) {
        a[row + static_cast<std::size_t>(j - 1)] = entry(i, j, k);
        if (i != j) sum += std::abs(entry(i, j, k));
      }
      a[row + static_cast<std::size_t>(i - 1)] = sum;
      b[static_cast<std::size_t>(10 * (k - 1) + i - 1)] =
          std::exp(static_cast<double>(i) / k) * std::sin(i * k);
    }
  }
  return {"MAXQUAD", std::vector<double>(10, 1.0), -0.8414083346, [a, b](Span x, MutableSpan g) {
            MaxOfPieces f(g);
            for (std::size_t k = 0; k < 5; ++k) {
              std::array<double, 10> product{};
              double value = 0;
              for (std::size_t i = 0; i < 10; ++i) {
                for (std::size_t j = 0; j < 10; ++j) product[i] += a[100 * k + 10 * i + j] * x[j];
                value += x[i] * (product[i] - b[10 * k + i]);
              }
              f.add(value, [&](MutableSpan d) {
                for (std::size_t i = 0; i < 10; ++i) d[i] = 2 * product[i] - b[10 * k + i];
              });
            }
            return f.value();
          }};
}

/// x_i = i for the first half, -i for the second.
inline std::vector<double> rising_and_falling(int n) {
  std::vector<double> x;
  for (int i = 1; i <= n; ++i) x.push_back(i <= n / 2 ? i : -i);
  return x;
}

/// [19] max x_i^2; minimum 0.
inline NonsmoothProblem maxq(int n = 20) {
  return {"MAXQ", rising_and_falling(n), 0, [](Span x, MutableSpan g) {
            std::fill(g.begin(), g.end(), 0.0);
            std::size_t best = 0;
            for (std::size_t i = 1; i < x.size(); ++i) {
              if (std::abs(x[i]) > std::abs(x[best])) best = i;
            }
            g[best] = 2 * x[best];
            return x[best] * x[best];
          }};
}

/// [20] max |x_i|; minimum 0.
inline NonsmoothProblem maxl(int n = 20) {
  return {"MAXL", rising_and_falling(n), 0, [](Span x, MutableSpan g) {
            std::fill(g.begin(), g.end(), 0.0);
            std::size_t best = 0;
            for (std::size_t i = 1; i < x.size(); ++i) {
              if (std::abs(x[i]) > std::abs(x[best])) best = i;
            }
            g[best] = x[best] < 0 ? -1 : 1;
            return std::abs(x[best]);
          }};
}

/// a(i, j) of TR48; staying in a city is forbidden by a distance of 100,000.
inline double tr48_distance(std::size_t i, std::size_t j) {
  if (i == j) return 1e5;
  const std::size_t first = std::min(i, j);
  const std::size_t before = first * (2 * kTr48Size - first - 1) / 2;  // entries of earlier rows
  return kTr48Distances[before + std::max(i, j) - first - 1];
}

/// [21] sum_j d_j max over i of (x_i - a_ij) - sum_i s_i x_i, the dual of a transportation problem
/// between 48 cities.
inline NonsmoothProblem tr48() {
  return {"TR48", std::vector<double>(kTr48Size, 0.0), -638565, [](Span x, MutableSpan g) {
            double value = 0;
            for (std::size_t i = 0; i < kTr48Size; ++i) {
              g[i] = -kTr48Supplies[i];
              value -= kTr48Supplies[i] * x[i];
            }
            for (std::size_t j = 0; j < kTr48Size; ++j) {
              std::size_t best = 0;
              for (std::size_t i = 1; i < kTr48Size; ++i) {
                if (x[i] - tr48_distance(i, j) > x[best] - tr48_distance(best, j)) best = i;
              }
              g[best] += kTr48Demands[j];
              value += kTr48Demands[j] * (x[best] - tr48_distance(best, j));
            }
            return value;
          }};
}

/// [22] n max x_i - sum x_i; minimum 0.
inline NonsmoothProblem goffin(int n = 50) {
  std::vector<double> start;
  for (int i = 1; i <= n; ++i) start.push_back(i - (n + 1) / 2.0);
  return {"Goffin", start, 0, [](Span x, MutableSpan g) {
            std::fill(g.begin(), g.end(), -1.0);
            const auto n_real = static_cast<double>(x.size());
            const auto best = std::max_element(x.begin(), x.end());
            g[static_cast<std::size_t>(best - x.begin())] += n_real;
            double value = n_real * *best;
            for (const double xi : x) value -= xi;
            return value;
          }};
}

/// Row i of the Hilbert matrix times x.
inline double hilbert_row(Span x, std::size_t i) {
  double sum = 0;
  for (std::size_t j = 0; j < x.size(); ++j) sum += x[j] / static_cast<double>(i + j + 1);
  return sum;
}

/// [23] max over i of |sum_j x_j / (i + j - 1)|; minimum 0.
inline NonsmoothProblem mxhilb(int n = 50) {
  return {"MXHILB",
          std::vector<double>(static_cast<std::size_t>(n), 1.0),
          0,
          [](Span x, MutableSpan g) {
            MaxOfPieces f(g);
            for (std::size_t i = 0; i < x.size(); ++i) {
              const double sum = hilbert_row(x, i);
              f.add(std::abs(sum), [&](MutableSpan d) {
                for (std::size_t j = 0; j < d.size(); ++j) {
                  d[j] = (sum < 0 ? -1 : 1) / static_cast<double>(i + j + 1);
                }
              });
            }
            return f.value();
          }};
}

/// [24] sum over i of |sum_j x_j / (i + j - 1)|; minimum 0.
inline NonsmoothProblem l1hilb(int n = 50) {
  return {"L1HILB",
          std::vector<double>(static_cast<std::size_t>(n), 1.0),
          0,
          [](Span x, MutableSpan g) {
            std::fill(g.begin(), g.end(), 0.0);
            double value = 0;
            for (std::size_t i = 0; i < x.size(); ++i) {
              const double sum = hilbert_row(x, i);
              value += std::abs(sum);
              for (std::size_t j = 0; j < x.size(); ++j) {
                g[j] += (sum < 0 ? -1 : 1) / static_cast<double>(i + j + 1);
              }
            }
            return value;
          }};
}

/// sum over i < n of LQ(x_i, x_i+1); minimum -(n - 1) sqrt 2.
inline NonsmoothProblem chained_lq(int n = 1000) {
  return {"chained LQ",
          std::vector<double>(static_cast<std::size_t>(n), -0.5),
          -(n - 1) * std::sqrt(2.0),
          [](Span x, MutableSpan g) {
            std::fill(g.begin(), g.end(), 0.0);
            double value = 0;
            for (std::size_t i = 0; i + 1 < x.size(); ++i) {
              const double r = x[i] * x[i] + x[i + 1] * x[i + 1] - 1;
              value += -x[i] - x[i + 1] + std::max(0.0, r);
              g[i] += -1 + (r > 0 ? 2 * x[i] : 0);
              g[i + 1] += -1 + (r > 0 ? 2 * x[i + 1] : 0);
            }
            return value;
          }};
}

/// All of them, small ones first.
inline std::vector<NonsmoothProblem> nonsmooth_problems() {
  return {cb2(),
          cb3(),
          dem(),
          ql(),
          lq(),
          mifflin1(),
          mifflin2(),
          wolfe(),
          rosen_suzuki(),
          shor(),
          colville1(),
          maxquad(),
          maxq(),
          maxl(),
          tr48(),
          goffin(),
          mxhilb(),
          l1hilb(),
          chained_lq()};
}

}  // namespace nda::test
