#include <gtest/gtest.h>

#include <cmath>

#include "floc/elasticity/moduli.h"
#include "floc/packing/balance.h"
#include "support/crystals.h"

namespace floc::test {
namespace {

constexpr double kRatio = 14.0 / 17.0;  // K_T/K_N at nu = 0.3

/// Returns a crystal of spheres with Hertz contacts, with the diameter a = 1, E = 1 and the given overlap.
Packing<3> hertz_crystal(const CubicCrystal& crystal, double overlap) {
  Packing<3> packing = crystal_of(crystal, 1.0 - overlap, 1.0, elastic_law(1.0, 0.5, 0.0));
  make_hertzian(1.0, kRatio, packing);
  return packing;
}

Moduli full_moduli(const Packing<3>& packing, bool prestress = false) {
  ModuliOptions options;
  options.strains = StrainSet::full;
  options.prestress = prestress;
  return elastic_moduli(packing, options);
}

double pressure(const Packing<3>& packing) {
  return static_stress(packing).trace() / 3.0;
}

TEST(HertzCrystal, HasItsPressureSolidFractionAndBulkModulus) {
  // Values for glass at 100 MPa, where P = kappa^(-3/2). The columns are the overlap, Phi, B without prestress, and B
  // with prestress.
  const double P = std::pow(83.953299, -1.5);
  const double closed[3][4] = {{0.02398742, 0.5631607545, 0.02644753, 0.02731420},
                               {0.01679556, 0.7156307881, 0.03805071, 0.03891738},
                               {0.01218744, 0.7682277444, 0.05268360, 0.05355027}};
  for (int k = 0; k < 3; ++k) {
    const CubicCrystal crystal = cubic_crystals()[k];
    const Packing<3> packing = hertz_crystal(crystal, closed[k][0]);
    // The overlap h is given with seven digits, and P is proportional to h^1.5. B is proportional to h^0.5.
    EXPECT_NEAR(pressure(packing), P, 5e-7 * P) << crystal.name;
    EXPECT_NEAR(solid_fraction(packing), closed[k][1], 2e-8) << crystal.name;
    EXPECT_NEAR(full_moduli(packing).B, closed[k][2], 1e-8) << crystal.name;
    EXPECT_NEAR(full_moduli(packing, true).B, closed[k][3], 1e-8) << crystal.name;
  }
}

/// Expects the moduli C11, C12 and C44 of a crystal in which every sphere is a centre of symmetry.
void expect_cubic(const CubicCrystal& crystal, const Moduli& m, double c11, double c12, double c44,
                  double tolerance) {
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(m.C(a, a), c11, tolerance) << crystal.name;
    EXPECT_NEAR(m.C(a, (a + 1) % 3), c12, tolerance) << crystal.name;
    EXPECT_NEAR(m.C(3 + a, 3 + a), c44, tolerance) << crystal.name;
  }
}

TEST(HertzCrystal, HasTheModuliOfItsNetwork) {
  const double h = 0.01, r = 1.0 - h, kn = 0.5 * std::sqrt(h), kt = kRatio * kn;
  expect_cubic(simple_cubic(), full_moduli(hertz_crystal(simple_cubic(), h)), kn / r, 0.0, kt / (2.0 * r),
               1e-14);
  const double bcc = std::sqrt(3.0) * r;
  expect_cubic(body_centred_cubic(), full_moduli(hertz_crystal(body_centred_cubic(), h)), (kn + 2.0 * kt) / bcc,
               (kn - kt) / bcc, (kn + 0.5 * kt) / bcc, 1e-14);
  expect_cubic(face_centred_cubic(), full_moduli(hertz_crystal(face_centred_cubic(), h)),
               std::sqrt(2.0) * (kn + kt) / r, (kn - kt) / (std::sqrt(2.0) * r),
               (kn + kt) / (std::sqrt(2.0) * r), 1e-14);
}

TEST(HertzCrystal, OfFccHasItsNumbers) {
  Packing<3> fcc = hertz_crystal(face_centred_cubic(), 0.01);
  EXPECT_NEAR(pressure(fcc), 9.619519e-4, 5e-11);
  EXPECT_NEAR(solid_fraction(fcc), 0.7631467101, 5e-11);
  expect_cubic(face_centred_cubic(), full_moduli(fcc), 0.1302455, 6.302199e-3, 0.06512273, 5e-8);
  for (Contact<3>& c : fcc.contacts) c.kt = 0.0;
  expect_cubic(face_centred_cubic(), full_moduli(fcc, true), 0.07094395, 0.03691490, 0.03499100, 5e-9);
}

/// Returns spheres at the sites of a lattice, with branch length and K_N equal to 1. Each sphere touches all spheres at
/// a distance of one.
Packing<3> unit_springs(const Mat<3>& cell, const std::vector<Vec<3>>& places) {
  Packing<3> packing;
  packing.law = elastic_law(1.0, kRatio, 0.0);
  packing.cell.matrix = cell;
  packing.grains = Grains<3>::with_size(static_cast<int>(places.size()));
  packing.grains.position = places;
  packing.grains.radius.assign(places.size(), 0.5005);
  packing.grains.mass.assign(places.size(), 1.0);
  find_contacts(packing);
  return packing;
}

TEST(HertzCrystal, OfHexagonalPackingRelaxesInside) {
  const double height = std::sqrt(8.0 / 3.0);
  Mat<3> cell;
  cell << 1.0, 0.0, 0.0, 0.5, std::sqrt(0.75), 0.0, 0.0, 0.0, height;
  const Moduli m =
      full_moduli(unit_springs(cell, {Vec<3>::Zero(), Vec<3>(0.5, std::sqrt(0.75) / 3.0, 0.5 * height)}));
  EXPECT_NEAR(m.C(0, 0), 2.640893227, 1e-9);
  EXPECT_NEAR(m.C(1, 1), 2.640893227, 1e-9);
  EXPECT_NEAR(m.C(0, 1), 0.104344865, 1e-9);
  EXPECT_NEAR(m.C(0, 2), 0.083189033, 1e-9);
  EXPECT_NEAR(m.C(2, 2), 2.662049059, 1e-9);
  EXPECT_NEAR(m.C(3, 3), 1.247835496, 1e-9);
  EXPECT_NEAR(m.C(4, 4), 1.247835496, 1e-9);
  EXPECT_NEAR(m.C(5, 5), 1.268274181, 1e-9);
}

TEST(HertzCrystal, OfDiamondRelaxesInside) {
  Mat<3> cell;
  cell << 0.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 0.0;
  cell *= 2.0 / std::sqrt(3.0);
  const Vec<3> within = Vec<3>::Constant(1.0 / std::sqrt(3.0));
  const Moduli m = full_moduli(unit_springs(cell, {Vec<3>::Zero(), within}));
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(m.C(a, a), 0.382070031, 1e-9);
    EXPECT_NEAR(m.C(a, (a + 1) % 3), 0.025471335, 1e-9);
    EXPECT_NEAR(m.C(3 + a, 3 + a), 0.202072594, 1e-9);
  }
}

}  // namespace
}  // namespace floc::test
