#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "floc/elasticity/moduli.h"
#include "floc/io/jambashbulk.h"
#include "floc/packing/balance.h"
#include "floc/packing/law/contact_forces.h"
#include "support/network_packings.h"
#include "support/places.h"

namespace floc {
namespace {

/// Fixture: 16 frictionless disks in a skewed cell, in the format of jamBashbulk (data/packings/disks).
class FormatOfJamBashbulk : public ::testing::Test {
 protected:
  FormatOfJamBashbulk() {
    const Imported file = read_jambashbulk(test::source_directory() + "/data/packings/disks/disks16.txt", {});
    packing_ = std::get<State<2>>(file.state).packing;
    find_contacts(packing_);
  }
  Moduli moduli(bool prestress) const {
    ModuliOptions options;
    options.strains = StrainSet::full;
    options.prestress = prestress;
    return elastic_moduli(packing_, options);
  }
  Packing<2> packing_;
};

TEST_F(FormatOfJamBashbulk, IsUnderThePressureItsHeaderSays) {
  const Mat<2> stress = static_stress(packing_);
  EXPECT_EQ(packing_.contacts.size(), 33u);
  for (int a = 0; a < 2; ++a) EXPECT_NEAR(stress(a, a), 1e-3, 1e-12);
}

TEST_F(FormatOfJamBashbulk, IsStableAndWithinTheBounds) {
  const Moduli m = moduli(false);
  EXPECT_EQ(m.n_negative, 0);
  EXPECT_EQ(m.n_mechanisms, 0);
  EXPECT_EQ(m.n_rattlers, 0);
  EXPECT_LE(m.bounds.B_reuss, m.B_S);
  EXPECT_LE(m.B_S, m.B);
  EXPECT_LE(m.B, m.bounds.B_voigt);
  EXPECT_EQ(moduli(true).n_negative, 0);
}

/// Strains the cell and restores the balance of the frictionless disks with Newton's method.
Packing<2> strained(Packing<2> packing, const Mat<2>& strain) {
  const Mat<2> deformation = Mat<2>::Identity() - strain;
  packing.cell.matrix = packing.cell.matrix * deformation;
  for (Vec<2>& x : packing.grains.position) x = deformation * x;
  refresh_contacts(packing);
  const int n = packing.grains.size();
  for (int step = 0; step < 6; ++step) {
    const Balance<2> net = net_forces(packing);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * n);
    for (int i = 0; i < n; ++i) force.segment<2>(3 * i) = net.force[i];
    const StiffnessMatrix k = stiffness_matrix(contact_network(packing), {StrainSet::diagonal, true});
    const Eigen::MatrixXd whole = Eigen::MatrixXd(k.whole()).topLeftCorner(3 * n, 3 * n);
    const Eigen::VectorXd move = whole.completeOrthogonalDecomposition().solve(force);
    for (int i = 0; i < n; ++i) packing.grains.position[i] += move.segment<2>(3 * i);
    refresh_contacts(packing);
  }
  return packing;
}

TEST_F(FormatOfJamBashbulk, ModuliWithPrestressAreDerivativesOfTheCauchyStress) {
  constexpr double kStep = 1e-6;
  const Moduli m = moduli(true);
  const Mat<2> stress = static_stress(packing_);
  // The moduli contain only the symmetric part of the convective terms (docs/physics.md, "Prestress"). The derivative
  // of the Cauchy stress also contains their antisymmetric part, which is of the order of the shear stress.
  const auto convected = [&](int a, int b) {
    const Mat<2> e = unit_strain<2>(b), turned = stress * e;
    return ((stress * e.trace() - 0.5 * (turned + turned.transpose())) * unit_strain<2>(a)).trace();
  };
  for (int b = 0; b < 3; ++b) {
    const Mat<2> e = unit_strain<2>(b);
    const Mat<2> change =
        (static_stress(strained(packing_, kStep * e)) - static_stress(strained(packing_, -kStep * e))) /
        (2.0 * kStep);
    for (int a = 0; a < 3; ++a) {
      // The rounding of positions of order 10, divided by the step, gives an error of 1e-9. The truncation error is of
      // the order of step^2 divided by the overlap of 1e-3.
      const double expected = m.C(a, b) + 0.5 * (convected(a, b) - convected(b, a));
      EXPECT_NEAR((change * unit_strain<2>(a)).trace(), expected, 1e-7) << a << " " << b;
    }
  }
}

}  // namespace
}  // namespace floc
