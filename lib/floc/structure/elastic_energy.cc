#include "floc/structure/elastic_energy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace floc {
namespace {

/// Relative rounding allowed in 2 K_N h = 3 N, of overlaps down to 1e-7 diameters that were written with 15
/// digits.
constexpr double kHertzian = 1e-6;

/// Energy of a spring; one without stiffness carries nothing.
double spring_energy(double squared_force, double stiffness) {
  return stiffness > 0.0 ? 0.5 * squared_force / stiffness : 0.0;
}

}  // namespace

template <int Dim>
double elastic_energy(const Contact<Dim>& c) {
  if (c.distant) return 0.0;
  const double N = c.elastic_force, h = -c.gap;
  const double normal = N > 0.0 && h > 0.0 ? N * N * h / (N + c.kn * h) : 0.0;
  return normal + spring_energy(c.shear_force.squaredNorm(), c.kt) +
         spring_energy(c.rolling_moment.squaredNorm(), c.kr) +
         spring_energy(c.twisting_moment * c.twisting_moment, c.ktw);
}

template <int Dim>
double elastic_energy_per_grain(const Packing<Dim>& packing) {
  double sum = 0.0;
  for (const Contact<Dim>& c : packing.contacts) sum += elastic_energy(c);
  return packing.grains.size() > 0 ? sum / packing.grains.size() : 0.0;
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
    const double Ri = packing.grains.radius[c.i], Rj = packing.grains.radius[c.j];
    largest = std::max(largest.value_or(0.0), hertz_contact_pressure(N, h, Ri * Rj / (Ri + Rj)));
  }
  return largest;
}

template double elastic_energy(const Contact<2>&);
template double elastic_energy(const Contact<3>&);
template double elastic_energy_per_grain(const Packing<2>&);
template double elastic_energy_per_grain(const Packing<3>&);

}  // namespace floc
