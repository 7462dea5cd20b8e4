#include "floc/structure/bond_signs.h"

#include <cmath>
#include <numbers>

#include "floc/base/range.h"

namespace floc {

template <int Dim>
BondSigns bond_signs(const Packing<Dim>& packing, double near) {
  require_in_range("near", near, kNotNegativeNumber);
  BondSigns out;
  int n_plus = 0, n_minus = 0;
  for (const Contact<Dim>& c : packing.contacts) {
    if (packing.is_wall(c.j)) continue;
    ++out.n_bonds;
    if (std::abs(c.normal_force) < near || c.normal_force == 0.0) continue;
    const bool pressed = c.normal_force > 0.0;
    ++(pressed ? n_plus : n_minus);
    (pressed ? out.mean_plus : out.mean_minus) += std::abs(c.normal_force);
  }
  if (n_plus > 0) out.mean_plus /= n_plus;
  if (n_minus > 0) out.mean_minus /= n_minus;
  if (n_plus + n_minus > 0) out.minus_share = static_cast<double>(n_minus) / (n_plus + n_minus);
  const int n = packing.grains.size();
  if (n == 0) return out;
  out.z = 2.0 * out.n_bonds / n;
  out.z_plus = 2.0 * n_plus / n;
  out.z_minus = 2.0 * n_minus / n;
  out.z_near = 2.0 * (out.n_bonds - n_plus - n_minus) / n;
  return out;
}

double virial_strength(int dimension, double z, double solid_fraction, double F0, double d) {
  return z * solid_fraction * F0 / (std::numbers::pi * std::pow(d, dimension - 1));
}

double rumpf_strength(int dimension, double solid_fraction, double F0, double d) {
  return virial_strength(dimension, std::numbers::pi / (1.0 - solid_fraction), solid_fraction, F0, d);
}

template BondSigns bond_signs(const Packing<2>&, double);
template BondSigns bond_signs(const Packing<3>&, double);

}  // namespace floc
