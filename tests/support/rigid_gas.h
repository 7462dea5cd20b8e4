#pragma once

#include <cstdint>
#include <optional>

#include "floc/assembly/shaped_gas.h"
#include "floc/relaxation/contact_dynamics_relaxer.h"
#include "support/rigid_states.h"

/// Gases of rigid grains and their relaxation under a pressure of 1.
namespace floc::test {

struct RigidGas {
  int count = 100;
  double least = 0.5;  ///< diameter of the smallest grain; that of the largest is 1
  std::optional<ShapeOptions> shape;
  double friction = 0.0;
  std::optional<double> adhesion;  ///< F0, over the pressure times the largest diameter^(Dim - 1)
  std::uint64_t seed = 1;
};

/// Makes the gas, as a scene file does whose gas is about half as dense as it can be.
template <int Dim>
Packing<Dim> make_rigid_gas(const RigidGas& gas) {
  GrainOptions grains;
  grains.count = gas.count;
  grains.diameter.kind = DiameterDistribution::Kind::power_law;
  grains.diameter.min = gas.least;
  grains.diameter.max = 1.0;
  grains.diameter.exponent = gas.least < 0.2 ? Dim : 0;
  grains.shape = gas.shape;
  const Law law = rigid_law(gas.friction, gas.adhesion);
  RandomStream random(gas.seed, 1);
  constexpr double kOfBalls = Dim == 2 ? 0.4 : 0.3;
  if (!gas.shape) return make_gas<Dim>(grains, law, kOfBalls, random);
  const double share = share_of_bounding_balls(
      shaped_grains<Dim>(grains, equally_spaced_diameters(grains.diameter, gas.count), gas.seed));
  return make_shaped_gas<Dim>(grains, law, kOfBalls * share, gas.seed, random, GasKind::equilibrated);
}

/// Settings of the shipped scenes of rigid grains.
inline RelaxationOptions rigid_options() {
  RelaxationOptions options;
  options.inertial_number_cap = 0.02;
  return options;
}

template <int Dim>
ContactDynamicsRelaxer<Dim> relaxer_of(Packing<Dim> packing, const RelaxationOptions& options = rigid_options()) {
  return {options, std::move(packing), LoadTarget<Dim>::normal_stress(Vec<Dim>::Ones())};
}

}  // namespace floc::test
