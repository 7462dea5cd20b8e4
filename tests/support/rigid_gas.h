#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "floc/assembly/box_options.h"
#include "floc/assembly/shaped_gas.h"
#include "floc/base/error.h"
#include "floc/packing/balance.h"
#include "floc/relaxation/contact_dynamics_relaxer.h"
#include "floc/rigid/contact_dynamics.h"
#include "floc/rigid/contact_points.h"
#include "floc/verification/verify_rigid.h"
#include "support/rigid_states.h"

/// Gases of rigid grains, and their relaxation under a pressure of 1.
namespace floc::test {

/// Parameters of a gas whose largest grain has the diameter 1.
struct RigidGas {
  int count = 100;
  double least = 0.5;                      ///< diameter of the smallest grain
  std::optional<ShapeOptions> shape = {};  ///< absent for disks and spheres
  double friction = 0.0;
  std::optional<double> adhesion = {};  ///< largest attraction of a contact (force)
  std::uint64_t seed = 1;
};

/// Returns the load of a periodic cell under a pressure on all sides.
inline BoundaryLoad<3> pressure_on_all_sides(double pressure) {
  BoundaryLoad<3> load;
  load.stress = Vec<3>::Constant(pressure);
  load.under_stress.fill(true);
  return load;
}

template <int Dim>
Packing<Dim> make_rigid_gas(const RigidGas& gas) {
  GrainOptions grains;
  grains.count = gas.count;
  grains.diameter.kind = DiameterDistribution::Kind::power_law;
  grains.diameter.min = gas.least;
  grains.diameter.max = 1.0;
  grains.diameter.exponent =
      gas.least < 0.2 ? Dim : 0.0;  // with the exponent Dim, equal intervals of ln d fill equal volumes
  grains.shape = gas.shape;
  const Law law = rigid_law(gas.friction, gas.adhesion);
  RandomStream random(gas.seed, 1);
  // fraction of the cell that the circumscribed circles or spheres fill
  constexpr double kSolidFraction = Dim == 2 ? 0.4 : 0.3;
  if (!gas.shape) return make_gas<Dim>(grains, law, kSolidFraction, random);
  // make_gas() will draw the diameters from this stream. A copy of the stream gives the same diameters in advance. The
  // volume fraction of the grains is computed from them.
  RandomStream copy = random;
  const std::vector<double> diameters = draw_diameters(grains, copy);
  const double share = share_of_bounding_balls(shaped_grains<Dim>(grains, diameters, gas.seed));
  return make_shaped_gas<Dim>(grains, law, 0.95 * kSolidFraction * share, gas.seed, random,
                              GasKind::equilibrated);
}

/// Returns a gas of rigid grains in a box; the largest diameter is at most 1.
template <int Dim>
Packing<Dim> boxed_gas(int count, const std::optional<ShapeOptions>& shape, const BoxOptions& box,
                       double friction) {
  GrainOptions grains;
  grains.count = count;
  grains.diameter.kind = DiameterDistribution::Kind::uniform;
  grains.diameter.min = 0.5;
  grains.diameter.max = 1.0;
  grains.shape = shape;
  RandomStream random(3, 1);
  const double fraction = Dim == 2 ? 0.25 : 0.08;
  if (!shape) return make_boxed_gas<Dim>(grains, rigid_law(friction), box, fraction, random);
  return make_boxed_shaped_gas<Dim>(grains, rigid_law(friction), box, fraction, 3, random,
                                    GasKind::sequential_addition);
}

/// Returns a gas of grains with corners. The cell and the positions of the grains have been compressed until the
/// closest pair has a gap of 0.01 to 0.02.
inline Packing<3> make_dense_gas(const RigidGas& gas) {
  for (Packing<3> packing = make_rigid_gas<3>(gas);;) {
    Packing<3> denser = packing;
    denser.cell.matrix *= 0.99;
    for (Vec<3>& x : denser.grains.position) x *= 0.99;
    if (!ContactPoints<3>().find(denser, 0.01).empty()) return packing;
    packing = std::move(denser);
  }
}

/// Relaxation settings of the shipped scenes of rigid grains.
inline RelaxationOptions rigid_options() {
  RelaxationOptions options;
  options.inertial_number_cap = 0.02;
  return options;
}

/// Result of the relaxation of a packing of rigid grains.
template <int Dim>
struct RigidEnd {
  RelaxationStatus status =
      RelaxationStatus::running;  ///< `running` if an exception or the limit of steps ended the relaxation
  RelaxationReport report;
  std::string progress;
  std::string reason;  ///< message of the exception, or criterion that is not met; empty for a state at rest
  Packing<Dim> packing;
};

/// Relaxes a packing under a load.
/// @param remade  whether each chunk of steps is made by a new relaxer, which gets the packing and the progress of the
/// previous one
template <int Dim>
RigidEnd<Dim> relaxed_under(const LoadTarget<Dim>& load, Packing<Dim> packing,
                            const RelaxationOptions& options = rigid_options(), bool remade = false,
                            std::int64_t most_steps = 40'000) {
  auto relaxer = std::make_unique<ContactDynamicsRelaxer<Dim>>(options, std::move(packing), load);
  RigidEnd<Dim> end;
  try {
    while (end.status == RelaxationStatus::running && relaxer->report().n_steps < most_steps) {
      end.status = relaxer->advance();
      if (remade && end.status == RelaxationStatus::running) {
        const std::string progress = relaxer->progress();
        relaxer =
            std::make_unique<ContactDynamicsRelaxer<Dim>>(options, relaxer->release_packing(), load, progress);
      }
    }
    end.reason = relaxer->report().blocking;
  } catch (const NoResult& error) {
    end.reason = error.what();
  }
  end.report = relaxer->report();
  end.progress = relaxer->progress();
  end.packing = relaxer->release_packing();
  return end;
}

/// Relaxes a packing under a pressure of 1.
template <int Dim>
RigidEnd<Dim> relaxed(Packing<Dim> packing, const RelaxationOptions& options = rigid_options(),
                      bool remade = false, std::int64_t most_steps = 40'000) {
  return relaxed_under(LoadTarget<Dim>::normal_stress(Vec<Dim>::Ones()), std::move(packing), options, remade,
                       most_steps);
}

/// Expects that the results of two relaxations are identical bit for bit.
template <int Dim>
void expect_same(const RigidEnd<Dim>& a, const RigidEnd<Dim>& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.progress, b.progress);
  ASSERT_EQ(a.packing.contacts.size(), b.packing.contacts.size());
  for (std::size_t k = 0; k < a.packing.contacts.size(); ++k) {
    const Contact<Dim>&c = a.packing.contacts[k], &d = b.packing.contacts[k];
    EXPECT_TRUE(c.i == d.i && c.j == d.j && c.key == d.key && c.gap == d.gap &&
                c.normal_force == d.normal_force && c.shear_force == d.shear_force);
  }
  EXPECT_TRUE(a.packing.grains.position == b.packing.grains.position);
  EXPECT_TRUE(a.packing.cell.matrix == b.packing.cell.matrix);
}

/// Expects that a packing under a pressure of 1 meets all criteria of a state of rigid grains at rest.
template <int Dim>
void expect_verified(const Packing<Dim>& packing) {
  State<Dim> state;
  state.packing = packing;
  state.target_stress = Vec<Dim>::Ones();
  measure(state);
  for (const Criterion& criterion : verify_rigid(state, default_gap_tolerance(packing)))
    EXPECT_TRUE(criterion.holds) << criterion.name << ": "
                                 << (criterion.value ? std::to_string(*criterion.value) : "") << " "
                                 << criterion.where;
}

/// Expects that a relaxation has ended at rest, and that the state meets all criteria.
template <int Dim>
void expect_at_rest(const RigidEnd<Dim>& end) {
  ASSERT_EQ(end.status, RelaxationStatus::converged) << end.reason;
  expect_verified(end.packing);
}

/// Expects that a relaxation ended in a state at rest. Otherwise expects finite numbers in the packing, and a reason
/// for the failure.
template <int Dim>
void expect_at_rest_or_reason(const RigidEnd<Dim>& end) {
  if (end.status == RelaxationStatus::converged) return expect_verified(end.packing);
  EXPECT_GT(end.reason.size(), 20U);
  for (const Vec<Dim>& x : end.packing.grains.position) EXPECT_TRUE(x.allFinite());
  EXPECT_TRUE(end.packing.cell.matrix.allFinite());
}

/// Returns the state of a packing in motion, at the end of a relaxation under a load that imposes a strain.
template <int Dim>
State<Dim> state_in_motion(const RigidEnd<Dim>& end, const LoadTarget<Dim>& load) {
  State<Dim> state;
  state.packing = end.packing;
  state.target_side = load.side;
  state.target_offset = load.offset;
  state.target_stress = load.stress_with(static_stress(end.packing));
  state.motion = end.report.motion;
  measure(state);
  return state;
}

}  // namespace floc::test
