#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "floc/fitting/line_fit.h"

namespace floc {

/// Mobilised friction and volume along a test that strains a sample.
struct TestCurve {
  std::vector<double> strain;      ///< strain in the direction of the test, from 0 on
  std::vector<double> mobilised;   ///< measure of the friction that is mobilised
  std::vector<double> volumetric;  ///< volumetric strain, positive in compression

  std::size_t size() const { return strain.size(); }
};

/// Returns the reason why a test has no strength; empty if it may have one.
std::string why_no_strength(const TestCurve& curve);

/// Returns the index of the point of largest mobilised friction. @pre the curve is not empty
std::size_t peak_of(const TestCurve& curve);

/// Returns the line of the volumetric strain against the strain over the points around the peak with at least 95 % of its
/// friction, five at least, as far as there are so many.
LinearFit volume_at_peak(const TestCurve& curve, std::size_t peak);

/// Critical state of a test: its points from `first` on, or the reason why it has not come to one.
struct CriticalPart {
  std::size_t first = 0;
  std::string why_not;  ///< empty if the points are in the critical state
};

/// Returns the last part of a test: the points from the strain `from` on; absent: the last quarter of the strain. It is no
/// critical state if it has fewer than three points, or if the volume still changes by more than a tenth of the strain.
CriticalPart critical_part(const TestCurve& curve, const std::optional<double>& from);

}  // namespace floc
