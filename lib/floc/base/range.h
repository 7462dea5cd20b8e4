#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace floc {

/// Range of the numbers that an argument accepts. Infinities and NaN are in no range.
struct NumberRange {
  double least = -std::numeric_limits<double>::max();
  double most = std::numeric_limits<double>::max();
  bool without_least = false;  ///< `least` itself is too small

  bool holds(double x) const { return (without_least ? x > least : x >= least) && x <= most; }
  /// "a positive number", "a number from 4 to 1000"
  std::string words() const;
};

inline constexpr NumberRange kFiniteNumber{};
inline constexpr NumberRange kPositiveNumber{.least = 0.0, .without_least = true};
inline constexpr NumberRange kNotNegativeNumber{.least = 0.0};

/// Range of the whole numbers that an argument accepts.
struct WholeRange {
  std::int64_t least;
  std::int64_t most;

  bool holds(std::int64_t x) const { return x >= least && x <= most; }
  /// "a whole number from 2 to 100"
  std::string words() const;
};

inline constexpr WholeRange kPositiveWhole{.least = 1, .most = std::numeric_limits<std::int64_t>::max()};
inline constexpr WholeRange kNotNegativeWhole{.least = 0, .most = std::numeric_limits<std::int64_t>::max()};

/// Returns "NAME = VALUE: expected ...", or an empty string for a value in its range.
std::string range_fault(const std::string& name, double value, const NumberRange& range);
std::string range_fault(const std::string& name, std::int64_t value, const WholeRange& range);

/// Checks that a value is in its range. @throws InputError with the fault, where there is one
void require_in_range(const std::string& name, double value, const NumberRange& range);
void require_in_range(const std::string& name, std::int64_t value, const WholeRange& range);
/// Checks that options have no faults. @param faults  faults as listed by the validate() of the options
/// @throws InputError with all faults, if there are any
void refuse_faults(const std::vector<std::string>& faults);

}  // namespace floc
