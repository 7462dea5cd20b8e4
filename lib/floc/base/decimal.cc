#include "floc/base/decimal.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/base/parse_number.h"

namespace floc {
namespace {

/// Number of significant digits that are enough to tell any two doubles apart.
constexpr int kDigitsOfDouble = 17;
constexpr int kDigitsKept =
    34;  ///< number of significant digits of a text that are read; more digits would not change a double-double
constexpr int kExactPower = 22;  ///< largest n for which 10^n is exactly a double

DoubleDouble times_power_of_ten(DoubleDouble x, int exponent) {
  for (; exponent != 0; exponent -= std::clamp(exponent, -kExactPower, kExactPower)) {
    const double power = std::pow(10.0, std::min(std::abs(exponent), kExactPower));
    x = exponent > 0 ? x * power : x / power;
  }
  return x;
}

}  // namespace

DoubleDouble decimal(std::string_view text, double nearest) {
  text = trimmed(text);
  const std::size_t end = std::min(text.find_first_of("eE"), text.size());
  int exponent = 0;
  if (end < text.size()) exponent = parse_number<int>(text.substr(end + 1)).value_or(0);
  DoubleDouble digits;
  int n_digits = 0;
  bool fraction = false;
  for (const char c : text.substr(0, end)) {
    if (c == '.') fraction = true;
    if (c < '0' || c > '9') continue;
    if (n_digits < kDigitsKept) {
      digits = digits * 10.0 + DoubleDouble{static_cast<double>(c - '0'), 0.0};
      n_digits += n_digits > 0 || c != '0';
      exponent -= fraction;
    } else {
      exponent += !fraction;
    }
  }
  if (n_digits <= kDigitsOfDouble) return {nearest, 0.0};
  if (text.starts_with('-')) digits = -digits;
  const double left = (times_power_of_ten(digits, exponent) - DoubleDouble{nearest, 0.0}).rounded();
  // If a power of ten is beyond the range of doubles, `left` is infinite, NaN or much too large. The remainder is then
  // set to zero.
  const bool plausible = std::abs(left) <= std::numeric_limits<double>::epsilon() * std::abs(nearest);
  return {nearest, plausible ? left : 0.0};
}

}  // namespace floc
