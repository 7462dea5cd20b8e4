#pragma once

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "floc/elasticity/moduli.h"
#include "support/rigid_gas.h"

/// Elastic grains with corners, and their moduli by relaxed strains.
namespace floc::test {

inline Law spring_law(double stiffness, double friction) {
  LawParameters law;
  law.normal = LinearRepulsion{stiffness};
  if (friction > 0.0) law.friction = CoulombFriction{friction, 0.8 * stiffness};
  return law;
}

template <int Dim>
Packing<Dim> elastic_gas(int count, const ShapeOptions& shape, double stiffness, double friction,
                         std::uint64_t seed = 1) {
  Packing<Dim> gas = make_rigid_gas<Dim>({.count = count, .shape = shape, .friction = friction, .seed = seed});
  gas.law = spring_law(stiffness, friction);
  return gas;
}

/// Gives the contacts of a packing, between grains and on walls, springs and Coulomb friction.
template <int Dim>
void set_springs(Packing<Dim>& packing, double stiffness, double friction, double wall_friction) {
  packing.law = spring_law(stiffness, friction);
  BoxOptions box;
  box.friction = wall_friction;
  packing.wall_law = wall_law(packing.law, box);
}

/// Returns settings with tolerances near the rounding errors of the forces, which are about 1e-15 K_N times the size of
/// the cell.
template <int Dim>
RelaxationOptions strict_options() {
  RelaxationOptions options = rigid_options();
  options.tolerance.force = options.tolerance.stress = Dim == 2 ? 4e-10 : 8e-9;
  return options;
}

/// Returns the logarithmic strains (shortening positive) of a packing at rest after its stress has changed and it has
/// come to rest again.
template <int Dim>
Vec<Dim> strain_under(const Packing<Dim>& rested, const Vec<Dim>& stress) {
  const RigidEnd<Dim> end =
      relaxed_under(LoadTarget<Dim>::normal_stress(stress), rested, strict_options<Dim>());
  EXPECT_EQ(end.status, RelaxationStatus::converged) << end.reason;
  Vec<Dim> strain;
  for (int a = 0; a < Dim; ++a) strain[a] = -std::log(end.packing.cell.matrix(a, a) / rested.cell.matrix(a, a));
  return strain;
}

/// Expects that the moduli of an elastic packing that comes to rest from a gas, with prestress, agree with the strains
/// that small changes of the stress cause. The tolerance is 1e-6 of the largest modulus. Tangential forces make the matrix
/// of the measured moduli unsymmetric, by some P/K_N; its symmetric part is compared. Also expects that moduli without
/// prestress differ only by some P/K_N, and lie between their bounds.
/// @param gas   gas with springs of the stiffness `stiffness`
/// @param step  Change of the stress, divided by the pressure. The error of the measured strains is the tolerance of the
/// forces divided by the step; with larger steps, it is the change of the moduli with the stress.
template <int Dim>
void expect_moduli_of_strains(const Packing<Dim>& gas, double stiffness, double step) {
  constexpr double kSticks = 100.0;
  RigidEnd<Dim> rested = relaxed(gas, strict_options<Dim>());
  ASSERT_EQ(rested.status, RelaxationStatus::converged) << rested.reason;
  if (gas.law.has_friction())
    set_springs(rested.packing, stiffness, kSticks, gas.wall_law.has_friction() ? kSticks : 0.0);
  Mat<Dim> compliance;
  for (int b = 0; b < Dim; ++b) {
    const Vec<Dim> change = step * Vec<Dim>::Unit(b);
    compliance.col(b) = (strain_under<Dim>(rested.packing, Vec<Dim>::Ones() + change) -
                         strain_under<Dim>(rested.packing, Vec<Dim>::Ones() - change)) /
                        (2.0 * step);
  }
  const Mat<Dim> inverse = compliance.inverse(), by_strains = 0.5 * (inverse + inverse.transpose());
  ModuliOptions options;
  options.prestress = true;
  const Moduli m = elastic_moduli(rested.packing, options);
  EXPECT_LE((by_strains - m.C).cwiseAbs().maxCoeff(), 1e-6 * m.C.cwiseAbs().maxCoeff())
      << by_strains << "\ninstead of\n"
      << m.C;
  const Moduli plain = elastic_moduli(rested.packing, ModuliOptions{});
  EXPECT_EQ(*m.B_without_prestress, plain.B);
  EXPECT_LE(std::abs(plain.B - m.B), 100.0 / stiffness * m.B);
  EXPECT_LE(plain.bounds.B_reuss, plain.B * (1.0 + 1e-7));
  EXPECT_LE(plain.B, plain.bounds.B_voigt);
}

/// Expects the same of a packing in a periodic cell.
template <int Dim>
void expect_moduli_of_strains(int count, const ShapeOptions& shape, double friction, double step,
                              std::uint64_t seed = 1) {
  constexpr double kStiffness = 1e5;
  expect_moduli_of_strains(elastic_gas<Dim>(count, shape, kStiffness, friction, seed), kStiffness, step);
}

}  // namespace floc::test
