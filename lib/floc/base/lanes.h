#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

/// Functions that contact laws call in addition to + - * /. A law is evaluated on three types of numbers: `double`, a
/// dual number (a number with its derivatives, like Ceres' Jet), or a pack of several doubles (SIMD lanes). The
/// functions accept all three types. The comparison of two packs gives a mask. The function blend() uses a mask to
/// choose, in each lane, the value of one of two packs.
namespace floc::lanes {

/// Returns `when ? a : b`; for packs of doubles, the choice is made separately for each lane.
template <class Mask, class T>
inline T select(const Mask& when, const T& a, const T& b) {
  if constexpr (std::is_same_v<Mask, bool>) {
    return when ? a : b;
  } else {
    return blend(when, a, b);
  }
}

/// Returns whether a mask is set in any lane.
template <class Mask>
inline bool any_lane(const Mask& mask) {
  if constexpr (std::is_same_v<Mask, bool>) {
    return mask;
  } else {
    return any(mask);
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

template <class T>
inline T absolute(const T& value) {
  return max(value, T(-value));
}

/// Returns `value` limited to the interval [-bound, bound]. @pre bound >= 0
template <class T>
inline T clamp_magnitude(const T& value, const T& bound) {
  return max(min(value, bound), T(-bound));
}

/// Returns p * 2^n.
/// @param shifted  the sum n + 1.5 * 2^52, where n is a whole number
/// @pre neither p nor the result is subnormal
inline double times_power_of_two(double p, double shifted) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(p) + (std::bit_cast<std::uint64_t>(shifted) << 52));
}

/// Returns exp(x) for x <= 0 with an error of at most two units in the last place, and with identical results on every
/// processor. The result is a power of two times exp(r), where exp(r) with |r| <= ln(2)/2 is computed by a power
/// series. For x below -690, the result is exp(-690).
template <class T>
inline T exp_of_negative(const T& x) {
  if constexpr (std::is_same_v<T, double> || requires { T::kWidth; }) {
    // The number 1.5 * 2^52. If it is added to a number, the last bits of the sum are the nearest whole number.
    constexpr double kShift = 6755399441055744.0;
    const T in_range = max(x, T(-690.0));
    const T shifted = in_range * T(1.4426950408889634) + T(kShift);
    const T n = shifted - T(kShift);
    // r = x - n ln 2. Here, ln 2 is written as the sum of two constants, and the first constant has so few digits that
    // its product with n is exact.
    const T r = (in_range - n * T(6.93147180369123816490e-01)) - n * T(1.90821492927058770002e-10);
    const T q = r * r;
    // The power series of exp(r), up to the term r^13/13!, equals even + r * odd, where `even` and `odd` are power
    // series in q = r^2.
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
