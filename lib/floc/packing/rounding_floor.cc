#include "floc/packing/rounding_floor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "floc/packing/equilibrium.h"

namespace floc {
namespace {

constexpr double kHalfUnit = 0.5 * std::numeric_limits<double>::epsilon();

}  // namespace

template <int Dim>
RoundingFloor rounding_floor(const Packing<Dim>& packing, const Vec<Dim>& target_stress) {
  // Rounding error of the largest coordinate. The error is smaller if the low parts of the coordinates are stored, too.
  double resolution = kHalfUnit * packing.cell.matrix.cwiseAbs().maxCoeff();
  if (!packing.grains.position_low.empty()) resolution *= kHalfUnit;
  std::vector<double> stiffness(packing.grains.size(), 0.0);
  double largest_force = 0.0, affine = 0.0;
  for (const Contact<Dim>& c : packing.contacts) {
    const double k = std::max(std::abs(c.kn), c.kt);
    stiffness[c.i] += k;
    if (!packing.is_wall(c.j)) stiffness[c.j] += k;
    largest_force = std::max(largest_force, std::abs(c.normal_force));
    affine += k * branch(packing, c).squaredNorm();
  }
  const double stiffest = stiffness.empty() ? 0.0 : *std::max_element(stiffness.begin(), stiffness.end());
  const ForceScale scale = force_scale(packing, target_stress);
  if (!(scale.force > 0.0)) return {};
  return {(stiffest * resolution + kHalfUnit * largest_force) / scale.force,
          kHalfUnit * affine / packing.cell.volume() * std::pow(scale.length, Dim - 1) / scale.force};
}

template RoundingFloor rounding_floor(const Packing<2>&, const Vec<2>&);
template RoundingFloor rounding_floor(const Packing<3>&, const Vec<3>&);

}  // namespace floc
