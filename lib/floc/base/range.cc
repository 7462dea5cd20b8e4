#include "floc/base/range.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "floc/base/error.h"

namespace floc {
namespace {

template <class Range, class Value>
std::string fault(const std::string& name, Value value, const Range& range) {
  return range.holds(value) ? "" : fmt::format("{} = {}: expected {}", name, value, range.words());
}

}  // namespace

std::string NumberRange::words() const {
  constexpr double kLargest = std::numeric_limits<double>::max();
  if (most < kLargest)
    return without_least ? fmt::format("a number above {} and at most {}", least, most)
                         : fmt::format("a number from {} to {}", least, most);
  if (least == -kLargest) return "a finite number";
  if (least == 0.0) return without_least ? "a positive number" : "zero or a positive number";
  return fmt::format("a number {} {}", without_least ? "above" : "of at least", least);
}

std::string WholeRange::words() const {
  if (most < std::numeric_limits<std::int64_t>::max())
    return fmt::format("a whole number from {} to {}", least, most);
  return fmt::format("a whole number of at least {}", least);
}

std::string range_fault(const std::string& name, double value, const NumberRange& range) {
  return fault(name, value, range);
}

std::string range_fault(const std::string& name, std::int64_t value, const WholeRange& range) {
  return fault(name, value, range);
}

void require_in_range(const std::string& name, double value, const NumberRange& range) {
  if (!range.holds(value)) throw InputError("", range_fault(name, value, range));
}

void require_in_range(const std::string& name, std::int64_t value, const WholeRange& range) {
  if (!range.holds(value)) throw InputError("", range_fault(name, value, range));
}

void refuse_faults(const std::vector<std::string>& faults) {
  if (!faults.empty()) throw InputError("", fmt::format("{}", fmt::join(faults, "; ")));
}

}  // namespace floc
