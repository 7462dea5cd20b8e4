#include "floc/structure/elastic_energy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floc/contact/pair_geometry.h"

namespace floc {
namespace {

/// Relative tolerance of the relation 2 K_N h = 3 N of a Hertz contact (stiffness K_N, overlap h, normal force N). With
/// this tolerance, even an overlap of 1e-7 diameters passes if it is computed from positions with 15 digits.
constexpr double kHertzian = 1e-6;

}  // namespace

template <int Dim>
double elastic_energy_per_grain(const Packing<Dim>& packing) {
  return packing.grains.size() > 0 ? contact_energy(packing).elastic / packing.grains.size() : 0.0;
}

double hertz_contact_pressure(double N, double h, double R) {
  return 1.5 * N / (std::numbers::pi * R * h);
}

std::optional<double> largest_contact_pressure(const Packing<3>& packing) {
  std::optional<double> largest;
  for (const Contact<3>& c : packing.contacts) {
    const double N = c.elastic_force, h = -c.gap;
    if (c.distant || !(N > 0.0)) continue;
    if (std::abs(2.0 * c.kn * h - 3.0 * N) > kHertzian * N) return std::nullopt;
    const double Ri = packing.grains.radius[c.i];
    const double R = packing.is_wall(c.j) ? Ri : reduced(Ri, packing.grains.radius[c.j]);
    largest = std::max(largest.value_or(0.0), hertz_contact_pressure(N, h, R));
  }
  return largest;
}

template double elastic_energy_per_grain(const Packing<2>&);
template double elastic_energy_per_grain(const Packing<3>&);

}  // namespace floc
