#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "floc/elasticity/moduli.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/balance.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/relaxation/equilibrator.h"
#include "floc/relaxation/static_solver.h"
#include "support/contact_laws.h"
#include "support/crystals.h"
#include "support/dynamics.h"

namespace floc {
namespace {

Law glass(double friction) {
  Law law;
  law += test::hertz(0.91, 0.3);
  law += test::mindlin(friction);
  law += test::critical_damping(0.98);
  return law;
}

/// Returns the packing called state A: beads are assembled without friction, and then friction is switched on, so that
/// there are no tangential forces.
Packing<3> beads_put_together_without_friction(int n, double pressure, std::uint64_t seed) {
  RelaxationOptions options;
  options.inertial_number_cap = 1e-2;
  const auto relaxer =
      make_equilibrator<3>(options, test::gas_of<3>(n, glass(0.0), 0.45, seed), Vec<3>::Constant(pressure));
  while (relaxer->advance() == RelaxationStatus::running) continue;
  Packing<3> packing = relaxer->packing();
  packing.law = glass(0.3);
  refresh_contacts(packing);
  return packing;
}

Packing<3> solved(const Packing<3>& from, const Vec<3>& stress) {
  StaticSolverOptions options;
  options.target = 1e-12;
  options.max_iterations = 40;
  options.largest_displacement = 1.0;
  const auto solution = solve_statics(from, stress, options);
  EXPECT_LT(solution.residual, 1e-11) << solution.reason;
  return solution.packing;
}

/// Returns the compliance of a packing under isotropic pressure, from finite differences. Each entry is the logarithmic
/// shortening of a side, divided by the change of the stress on an axis.
Mat<3> compliance_by_differences(const Packing<3>& packing, double pressure) {
  const double step = 1e-4 * pressure;
  Mat<3> compliance;
  for (int a = 0; a < 3; ++a) {
    const auto sides_at = [&](double by) {
      const Packing<3> end = solved(packing, Vec<3>(Vec<3>::Constant(pressure) + by * Vec<3>::Unit(a)));
      EXPECT_EQ(end.contacts.size(), packing.contacts.size());
      return Vec<3>(end.cell.matrix.diagonal());
    };
    const Vec<3> more = sides_at(step), less = sides_at(-step);
    compliance.col(a) = (less.array().log() - more.array().log()) / (2.0 * step);
  }
  return compliance;
}

/// Returns the largest difference between compliance_by_differences() and the inverse of the moduli with
/// prestress, divided by the largest compliance.
double error_of_moduli(const Packing<3>& start, double pressure) {
  const Packing<3> packing = solved(start, Vec<3>::Constant(pressure));
  ModuliOptions options;
  options.prestress = true;
  const Mat<3> expected = Mat<3>(elastic_moduli(packing, options).C).inverse();
  const Mat<3> found = compliance_by_differences(packing, pressure);
  return (found - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

TEST(PrestressedModuli, OfAnFccCrystalAreRelaxedDifferences) {
  const Packing<3> crystal = test::crystal_of(test::face_centred_cubic(), 0.99, 1.0, glass(0.3));
  // P = z N/(6 c r^2), with the force N of a contact, the coordination number z, the branch length r and the volume c
  // r^3 per sphere
  const double pressure = 12.0 / (6.0 / std::sqrt(2.0) * 0.99 * 0.99) * std::pow(0.01, 1.5) / 3.0;
  EXPECT_NEAR(pressure, 9.619519e-4, 1e-9);
  EXPECT_LT(error_of_moduli(crystal, pressure), 1e-6);
}

/// A hexagonal close-packed crystal. Its cell contains two spheres, which move relative to each other under load. The
/// crystal is stiffer along its axis of symmetry. The tetrahedra of spheres therefore become irregular under pressure.
TEST(PrestressedModuli, OfAnHcpCrystalAreRelaxedDifferences) {
  const double distance = 0.99, height = std::sqrt(8.0 / 3.0) * distance, row = std::sqrt(0.75) * distance;
  Packing<3> crystal;
  crystal.law = glass(0.3);
  crystal.cell.matrix << distance, 0.0, 0.0, 0.5 * distance, row, 0.0, 0.0, 0.0, height;
  crystal.grains = Grains<3>::with_size(2);
  crystal.grains.position = {Vec<3>::Zero(), Vec<3>(0.5 * distance, row / 3.0, 0.5 * height)};
  crystal.grains.radius.assign(2, 0.5);
  crystal.grains.mass.assign(2, 1.0);
  find_contacts(crystal);
  EXPECT_EQ(crystal.contacts.size(), 12U);
  const double pressure = static_stress(crystal).trace() / 3.0;
  EXPECT_LT(error_of_moduli(crystal, pressure), 1e-6);
}

/// The contacts have no tangential force, and no contact opens or closes, so the effect of friction is of second order
/// in the step.
TEST(PrestressedModuli, OfBeadsPutTogetherWithoutFrictionAreRelaxedDifferences) {
  const double pressure = std::pow(400.0, -1.5);
  EXPECT_LT(error_of_moduli(beads_put_together_without_friction(500, pressure, 1), pressure), 1e-6);
}

}  // namespace
}  // namespace floc
