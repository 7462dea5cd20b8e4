#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns z(h): twice the number of pairs of surfaces no further apart than h, over the number of grains. Gaps
/// count up to a rounding error of 1e-12 diameters. z(0) is the coordination number of contacts.
/// @param gaps  h (length), ascending, >= 0
/// @return one entry per gap
template <int Dim>
std::vector<double> gap_coordination(const Packing<Dim>& packing, const std::vector<double>& gaps);

}  // namespace floc
