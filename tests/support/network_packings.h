#pragma once

#include <random>

#include "floc/neighbors/find_contacts.h"
#include "floc/packing/packing.h"
#include "support/contact_laws.h"

namespace floc::test {

/// Returns a linear law with normal, tangential and rolling stiffness. Its friction limits are larger than all forces
/// in the tests.
inline Law elastic_law(double kn, double kt, double kr) {
  Law law;
  law += test::linear(kn);
  if (kt > 0.0) law += test::coulomb(1e6, kt);
  if (kr > 0.0) law += test::rolling_spring(1e6, kr);
  return law;
}

/// Returns randomly placed grains of radius 0.35 to 0.65 in a skewed cell. The packing is so dense that the grains
/// cannot move freely, but it is not in equilibrium. If there are few grains, the cell is so small that grains touch
/// their own images.
template <int Dim>
Packing<Dim> random_packing(int n_grains, unsigned seed, const Law& law, double grains_per_volume = 1.6) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Packing<Dim> packing;
  packing.law = law;
  packing.grains = Grains<Dim>::with_size(n_grains);
  const double side = std::pow(n_grains / grains_per_volume, 1.0 / Dim);
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b)
      packing.cell.matrix(a, b) = side * ((a == b ? 1.0 : 0.0) + 0.3 * (uniform(engine) - 0.5));
  for (int i = 0; i < n_grains; ++i) {
    Vec<Dim> s;
    for (int a = 0; a < Dim; ++a) s[a] = uniform(engine);
    packing.grains.position[i] = packing.cell.matrix.transpose() * s;
    packing.grains.radius[i] = 0.35 + 0.3 * uniform(engine);
    packing.grains.mass[i] = 1.0;
  }
  find_contacts(packing);
  return packing;
}

}  // namespace floc::test
