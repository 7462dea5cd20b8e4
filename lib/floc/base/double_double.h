#pragma once

#include <cmath>

namespace floc {

/// A double-double number: the unevaluated sum high + low of two doubles, where |low| is at most half a unit in the
/// last place of `high`. The precision is about 106 bits. Double-double numbers are used where two nearly equal numbers
/// are subtracted and doubles are not precise enough. The operators use the algorithms of Dekker (1971) and the fast
/// "sloppy" algorithms of Hida, Li and Bailey (2001).
struct DoubleDouble {
  double high = 0.0;
  double low = 0.0;

  double rounded() const { return high + low; }
};

/// Returns p + q as a double-double number, without rounding error.
inline DoubleDouble exact_sum(double p, double q) {
  const double sum = p + q;
  const double q_taken = sum - p;
  return {sum, (p - (sum - q_taken)) + (q - q_taken)};
}

/// Returns p q as a double-double number, without rounding error unless the product underflows.
inline DoubleDouble exact_product(double p, double q) {
  const double product = p * q;
  return {product, std::fma(p, q, -product)};
}

inline DoubleDouble operator+(const DoubleDouble& p, const DoubleDouble& q) {
  const DoubleDouble high = exact_sum(p.high, q.high);
  const DoubleDouble low = exact_sum(p.low, q.low);
  const DoubleDouble most = exact_sum(high.high, high.low + low.high);
  return exact_sum(most.high, most.low + low.low);
}

inline DoubleDouble operator-(const DoubleDouble& p) {
  return {-p.high, -p.low};
}
inline DoubleDouble operator-(const DoubleDouble& p, const DoubleDouble& q) {
  return p + -q;
}

inline DoubleDouble operator*(const DoubleDouble& p, double q) {
  const DoubleDouble high = exact_product(p.high, q);
  return exact_sum(high.high, high.low + p.low * q);
}

inline DoubleDouble operator/(const DoubleDouble& p, double q) {
  const double first = p.high / q;
  const DoubleDouble left = p - exact_product(first, q);
  const double second = left.high / q;
  return exact_sum(first, second) + DoubleDouble{(left - exact_product(second, q)).high / q, 0.0};
}

inline DoubleDouble square(const DoubleDouble& p) {
  const DoubleDouble high = exact_product(p.high, p.high);
  return exact_sum(high.high, high.low + (2.0 * p.high * p.low + p.low * p.low));
}

}  // namespace floc
