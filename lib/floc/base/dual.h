#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

namespace floc {

/// A dual number: a value and its derivatives with respect to N variables. If the inputs of a formula are dual numbers,
/// the result contains the value of the formula and its derivatives (forward-mode automatic differentiation).
/// Comparisons ignore the derivatives, so that a program takes the same branches as with plain numbers.
template <int N>
struct Dual {
  double value = 0.0;
  std::array<double, N> derivative{};

  constexpr Dual() = default;
  /// Constructs a constant, whose derivatives are zero.
  constexpr Dual(double constant) : value(constant) {}  // NOLINT: implicit conversion is intended
  /// Constructs the variable with index `variable`, counted from 0, at the value `at`. The derivative with respect to
  /// this variable is 1; all other derivatives are 0.
  constexpr Dual(double at, int variable) : value(at) { derivative[variable] = 1.0; }

  constexpr Dual& operator+=(const Dual& q) { return *this = *this + q; }
  constexpr Dual& operator-=(const Dual& q) { return *this = *this - q; }
  constexpr Dual& operator*=(const Dual& q) { return *this = *this * q; }
  constexpr Dual& operator/=(const Dual& q) { return *this = *this / q; }

  friend constexpr Dual operator+(const Dual& p, const Dual& q) {
    return chain(p.value + q.value, p, 1.0, q, 1.0);
  }
  friend constexpr Dual operator-(const Dual& p, const Dual& q) {
    return chain(p.value - q.value, p, 1.0, q, -1.0);
  }
  friend constexpr Dual operator-(const Dual& p) { return chain(-p.value, p, -1.0); }
  friend constexpr Dual operator*(const Dual& p, const Dual& q) {
    return chain(p.value * q.value, p, q.value, q, p.value);
  }
  friend constexpr Dual operator/(const Dual& p, const Dual& q) {
    const double quotient = p.value / q.value;
    return chain(quotient, p, 1.0 / q.value, q, -quotient / q.value);
  }

  friend constexpr bool operator<(const Dual& p, const Dual& q) { return p.value < q.value; }
  friend constexpr bool operator>(const Dual& p, const Dual& q) { return p.value > q.value; }
  friend constexpr bool operator<=(const Dual& p, const Dual& q) { return p.value <= q.value; }
  friend constexpr bool operator>=(const Dual& p, const Dual& q) { return p.value >= q.value; }
  friend constexpr bool operator==(const Dual& p, const Dual& q) { return p.value == q.value; }

  friend Dual sqrt(const Dual& p) {
    const double root = std::sqrt(p.value);
    return chain(root, p, 0.5 / root);
  }
  friend Dual abs(const Dual& p) { return p.value < 0.0 ? -p : p; }
  friend Dual sin(const Dual& p) { return chain(std::sin(p.value), p, std::cos(p.value)); }
  friend Dual cos(const Dual& p) { return chain(std::cos(p.value), p, -std::sin(p.value)); }
  friend Dual exp(const Dual& p) {
    const double power = std::exp(p.value);
    return chain(power, p, power);
  }
  friend Dual atan(const Dual& p) { return chain(std::atan(p.value), p, 1.0 / (1.0 + p.value * p.value)); }
  friend Dual log(const Dual& p) { return chain(std::log(p.value), p, 1.0 / p.value); }
  friend Dual pow(const Dual& p, double exponent) {
    return chain(std::pow(p.value, exponent), p, exponent * std::pow(p.value, exponent - 1.0));
  }

 private:
  /// Return a function of p, or of p and q, as a dual number. Its derivatives follow by the chain rule from the
  /// derivatives of p and q.
  /// @param value  value of the function
  /// @param by_p,by_q  partial derivatives of the function with respect to p and q
  static constexpr Dual chain(double value, const Dual& p, double by_p) {
    Dual out(value);
    for (int k = 0; k < N; ++k) out.derivative[k] = by_p * p.derivative[k];
    return out;
  }
  static constexpr Dual chain(double value, const Dual& p, double by_p, const Dual& q, double by_q) {
    Dual out(value);
    for (int k = 0; k < N; ++k) out.derivative[k] = by_p * p.derivative[k] + by_q * q.derivative[k];
    return out;
  }
};

}  // namespace floc

/// Traits that let Eigen use dual numbers as matrix elements.
template <int N>
struct Eigen::NumTraits<floc::Dual<N>> : Eigen::NumTraits<double> {
  using Real = floc::Dual<N>;
  using NonInteger = floc::Dual<N>;
  using Nested = floc::Dual<N>;
  using Literal = floc::Dual<N>;
  enum { RequireInitialization = 1, ReadCost = N + 1, AddCost = N + 1, MulCost = 3 * N + 1 };
};
