#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns the coordination number z(h) of neighbours at gaps up to h: twice the number of pairs of grains whose gap is
/// at most h, divided by the number of grains. z(0) is the coordination number of contacts. For rounding, a gap may
/// exceed h by 1e-12 diameters.
/// @param gaps  values of h (length), ascending, >= 0
/// @return z(h) for each entry of `gaps`
template <int Dim>
std::vector<double> gap_coordination(const Packing<Dim>& packing, const std::vector<double>& gaps);

}  // namespace floc
