#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace floc {

/// Range of the real numbers that an argument accepts. Infinities and NaN are outside of every range.
struct NumberRange {
  double least = -std::numeric_limits<double>::max();
  double most = std::numeric_limits<double>::max();
  bool without_least = false;  ///< whether `least` itself is outside of the range

  bool holds(double x) const { return (without_least ? x > least : x >= least) && x <= most; }
  /// Returns a description of the range, for example "a positive number" or "a number from 4 to 1000".
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
  /// Returns a description of the range, for example "a whole number from 2 to 100".
  std::string words() const;
};

inline constexpr WholeRange kPositiveWhole{.least = 1, .most = std::numeric_limits<std::int64_t>::max()};
inline constexpr WholeRange kNotNegativeWhole{.least = 0, .most = std::numeric_limits<std::int64_t>::max()};

/// Returns the message "NAME = VALUE: expected RANGE" for a value outside of its range, otherwise an empty string.
std::string range_fault(const std::string& name, double value, const NumberRange& range);
std::string range_fault(const std::string& name, std::int64_t value, const WholeRange& range);

/// Checks that a value is in its range.
/// @throws InputError with the message of range_fault() if the value is outside of the range
void require_in_range(const std::string& name, double value, const NumberRange& range);
void require_in_range(const std::string& name, std::int64_t value, const WholeRange& range);
/// Throws if faults were found in the options of a computation.
/// @param faults  messages about the faults, from the function validate() of the options
/// @throws InputError with all messages, unless `faults` is empty
void refuse_faults(const std::vector<std::string>& faults);

}  // namespace floc
