#pragma once

#include <cmath>
#include <numeric>

#include "floc/assembly/gas.h"
#include "floc/relaxation/dynamics.h"

namespace floc::test {

/// The contact law of [GRC2008] in units F0 = a = m = 1, with small rolling resistance.
inline LawParameters cohesive_law() {
  LawParameters law;
  law.normal = LinearRepulsion{1e5};
  law.adhesion = TailAdhesion{1.0, 1e-3};
  law.damping = ViscousDamping{0.015, DampingMass::effective};
  law.friction = CoulombFriction{0.5, 1e5};
  law.rolling = RollingSpring{0.005, 10.0};
  return law;
}

/// A gas of disks with diameters uniform in [1/2, 1].
inline Packing<2> gas_of(int n, const LawParameters& law, double solid_fraction, std::uint64_t seed = 1) {
  GrainOptions grains;
  grains.count = n;
  grains.diameter.min = 0.5;
  grains.diameter.max = 1.0;
  RandomStream random(seed, 1);
  return make_gas<2>(grains, law, solid_fraction, random);
}

/// An agitated gas of cohesive disks, dense enough that many touch within a few hundred steps.
inline Packing<2> agitated_gas(int n, const LawParameters& law) {
  Packing<2> gas = gas_of(n, law, 0.6);
  RandomStream random(7, 2);
  agitate(gas, 1.0, random);
  return gas;
}

inline double total_mass(const Packing<2>& packing) {
  return std::accumulate(packing.grains.mass.begin(), packing.grains.mass.end(), 0.0);
}

inline BoundaryControl<2> pressed(const Packing<2>& packing, double pressure) {
  return BoundaryControl<2>::normal_stress(Vec<2>::Constant(pressure), total_mass(packing));
}

}  // namespace floc::test
