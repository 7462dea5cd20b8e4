#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "floc/fitting/line_fit.h"

namespace floc {

/// Mobilised friction and volumetric strain of a sample as functions of its strain in a mechanical test.
struct TestCurve {
  std::vector<double> strain;      ///< strain in the direction of the test, from 0 on
  std::vector<double> mobilised;   ///< sine or tangent of the mobilised friction angle
  std::vector<double> volumetric;  ///< volumetric strain, positive in compression

  std::size_t size() const { return strain.size(); }
};

/// Returns the reason why a test gives no strength, or an empty text.
std::string why_no_strength(const TestCurve& curve);

/// Returns the index of the point of largest mobilised friction. @pre the curve is not empty
std::size_t peak_of(const TestCurve& curve);

/// Fits a line of the volumetric strain against the strain. It is fitted to the points around the peak that have at
/// least 95 % of the mobilised friction at the peak. If there are fewer than five such points, their neighbours are
/// added.
LinearFit volume_at_peak(const TestCurve& curve, std::size_t peak);

/// Critical state of a test: the points from `first` on, or the reason why the test has not reached a critical state.
struct CriticalPart {
  std::size_t first = 0;
  std::string why_not;  ///< empty if the points are in the critical state
};

/// Returns the last part of a test: the points from the strain `from` on or, if `from` is absent, the last quarter of
/// the strain. This part is no critical state if it has fewer than three points, or if the change of the volumetric
/// strain in this part exceeds a tenth of the change of the strain.
CriticalPart critical_part(const TestCurve& curve, const std::optional<double>& from);

}  // namespace floc
