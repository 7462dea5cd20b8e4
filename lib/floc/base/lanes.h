#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

/// The few operations that a contact law uses beyond arithmetic, for every number type that it is evaluated on:
/// `double`, a dual number (like Ceres' Jet), or a pack of doubles, whose comparisons give masks with a `blend`
/// of their own.
namespace floc::lanes {

/// `when ? a : b`, lane by lane where the number type has lanes.
template <class Mask, class T>
inline T select(const Mask& when, const T& a, const T& b) {
  if constexpr (std::is_same_v<Mask, bool>) {
    return when ? a : b;
  } else {
    return blend(when, a, b);
  }
}

template <class T>
inline T min(const T& a, const T& b) {
  return select(a < b, a, b);
}

template <class T>
inline T max(const T& a, const T& b) {
  return select(a < b, b, a);
}

/// `value` limited to [-bound, bound], bound >= 0.
template <class T>
inline T clamp_magnitude(const T& value, const T& bound) {
  return max(min(value, bound), T(-bound));
}

/// p 2^n, where `shifted` is the whole number n plus 1.5 * 2^52. @pre neither p nor the result is subnormal
inline double times_power_of_two(double p, double shifted) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(p) + (std::bit_cast<std::uint64_t>(shifted) << 52));
}

/// exp(x) for x <= 0 to two units in the last place, the same on every processor: a power of two times a series
/// for exp(r), |r| <= ln(2)/2. Below x = -690 it stays at exp(-690).
template <class T>
inline T exp_of_negative(const T& x) {
  if constexpr (std::is_same_v<T, double> || requires { T::kWidth; }) {
    constexpr double kShift = 6755399441055744.0;  // 1.5 * 2^52
    const T in_range = max(x, T(-690.0));
    const T shifted = in_range * T(1.4426950408889634) + T(kShift);
    const T n = shifted - T(kShift);
    // ln 2 in two parts, the first of so few digits that its product with n is exact.
    const T r = (in_range - n * T(6.93147180369123816490e-01)) - n * T(1.90821492927058770002e-10);
    const T q = r * r;
    // Even and odd terms of the series, to r^13/13!.
    const T even =
        T(1) +
        q * (T(1.0 / 2) +
             q * (T(1.0 / 24) +
                  q * (T(1.0 / 720) + q * (T(1.0 / 40320) + q * (T(1.0 / 3628800) + q * T(1.0 / 479001600))))));
    const T odd =
        T(1) + q * (T(1.0 / 6) +
                    q * (T(1.0 / 120) +
                         q * (T(1.0 / 5040) +
                              q * (T(1.0 / 362880) + q * (T(1.0 / 39916800) + q * T(1.0 / 6227020800.0))))));
    return times_power_of_two(even + r * odd, shifted);
  } else {
    using std::exp;
    return exp(x);
  }
}

}  // namespace floc::lanes
