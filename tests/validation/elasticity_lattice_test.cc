#include <gtest/gtest.h>

#include <cmath>

#include "floc/elasticity/moduli.h"
#include "support/lattices.h"

namespace floc {
namespace {

constexpr double kN = 1.0;
constexpr double kT = 0.7;
constexpr double kR = 0.03;
constexpr double kSpacing = 1.3;
/// Tolerance for sums of a few terms, whose rounding errors are amplified by condition numbers of about 10.
constexpr double kRounding = 1e-12;

Moduli full_moduli(const Packing<2>& packing) {
  ModuliOptions options;
  options.strains = StrainSet::full;
  return elastic_moduli(packing, options);
}

/// Expects that the closed form of each modulus lies within its error bound.
void expect_within_bound(const Moduli& m, const Eigen::MatrixXd& closed) {
  for (int a = 0; a < closed.rows(); ++a)
    for (int b = 0; b < closed.cols(); ++b)
      EXPECT_LE(std::abs(m.C(a, b) - closed(a, b)), m.C_error(a, b)) << a << " " << b;
}

TEST(Lattice, SquareHasItsClosedForm) {
  const Moduli m = full_moduli(test::square_frames(2, kSpacing, test::elastic_law(kN, kT, kR)));
  const Eigen::Matrix3d expected = Eigen::Vector3d(kN, kN, kT / 2.0).asDiagonal();
  EXPECT_LT((m.C - expected).cwiseAbs().maxCoeff(), kRounding);
  expect_within_bound(m, expected);
  EXPECT_EQ(m.n_mechanisms, 0);
}

TEST(Lattice, TriangularIsIsotropicWithItsClosedForm) {
  const Moduli m = full_moduli(test::triangular(kSpacing, test::elastic_law(kN, kT, kR)));
  const double B = std::sqrt(3.0) / 2.0 * kN;
  const double G = std::sqrt(3.0) / 4.0 * (kN + kT);
  Eigen::Matrix3d expected;
  expected << B + G, B - G, 0.0, B - G, B + G, 0.0, 0.0, 0.0, G;
  EXPECT_LT((m.C - expected).cwiseAbs().maxCoeff(), kRounding);
  expect_within_bound(m, expected);
  EXPECT_LE(std::abs(m.B - B), m.B_error);
  EXPECT_LE(std::abs(m.B_S - B), m.B_S_error);
  EXPECT_LE(std::abs(m.G - G), m.G_error);
  EXPECT_NEAR(m.B, B, kRounding);
  EXPECT_NEAR(m.B_S, B, kRounding);
  EXPECT_NEAR(m.G, G, kRounding);
  EXPECT_LT(m.isotropy_defect, kRounding);
  // The displacements are affine and the forces on all contacts are equal, so all bounds equal the moduli.
  EXPECT_NEAR(m.bounds.B_voigt, B, kRounding);
  EXPECT_NEAR(m.bounds.G_voigt, G, kRounding);
  EXPECT_NEAR(m.bounds.B_reuss, B, kRounding);
  EXPECT_NEAR(m.bounds.Z2, 1.0, kRounding);
}

TEST(Lattice, HoneycombRelaxesToItsClosedForm) {
  const Moduli m = full_moduli(test::honeycomb(kSpacing, test::elastic_law(kN, kT, kR)));
  const double B = kN / (2.0 * std::sqrt(3.0));
  // The shear modulus follows from the minimum of the energy with respect to the relative displacement of the two
  // sublattices.
  const double G = kN * kT / (std::sqrt(3.0) * (kN + kT));
  EXPECT_NEAR(m.B, B, kRounding);
  EXPECT_NEAR(m.G, G, kRounding);
  EXPECT_NEAR(m.C(2, 2), G, kRounding);
  Eigen::Matrix3d expected;
  expected << B + G, B - G, 0.0, B - G, B + G, 0.0, 0.0, 0.0, G;
  expect_within_bound(m, expected);
  EXPECT_LT(m.G, m.bounds.G_voigt);
}

TEST(Lattice, FramesOfChainsBendAsTheTwoDiskEquivalentSays) {
  for (const int n : {2, 3, 4, 7}) {
    const Moduli m = full_moduli(test::square_frames(n, kSpacing, test::elastic_law(kN, kT, kR)));
    const double R = kSpacing / 2.0;
    const double transverse = (n - 1) / kT + n * (n - 1) * (n - 2) * R * R / (3.0 * kR);
    EXPECT_NEAR(m.C(0, 0), kN / (n - 1), kRounding);
    EXPECT_NEAR(m.C(0, 1), 0.0, kRounding);
    EXPECT_NEAR(m.C(2, 2), 0.5 / transverse, kRounding) << "n = " << n;
  }
}

/// The frames are so soft in shear that the stiffness matrix alone, in double precision, determines no digit of the
/// shear modulus. The modulus must nevertheless lie within its error bound, and the bound must be small compared with
/// the modulus.
TEST(Lattice, SoftFramesAreWithinTheirErrorBound) {
  for (const double rolling : {1.0, 1e-4, 1e-8})
    for (const int n : {3, 20, 100}) {
      const Moduli m = full_moduli(test::square_frames(n, kSpacing, test::elastic_law(kN, kT, rolling)));
      const double R = kSpacing / 2.0;
      const double transverse = (n - 1) / kT + n * (n - 1.0) * (n - 2) * R * R / (3.0 * rolling);
      const double shear = 0.5 / transverse;
      EXPECT_LE(std::abs(m.C(2, 2) - shear), m.C_error(2, 2)) << n << " " << rolling;
      EXPECT_LE(std::abs(m.C(0, 0) - kN / (n - 1)), m.C_error(0, 0)) << n << " " << rolling;
      EXPECT_LE(m.C_error(2, 2), 1e-6 * shear) << n << " " << rolling;
    }
}

/// Returns a packing of one sphere per cell. The sphere touches its images, at a distance of one spacing.
Packing<3> bravais(const Mat<3>& cell) {
  Packing<3> packing;
  packing.law = test::elastic_law(kN, kT, kR);
  packing.cell.matrix = kSpacing * cell;
  packing.grains = Grains<3>::with_size(1);
  packing.grains.radius[0] = 0.51 * kSpacing;
  find_contacts(packing);
  return packing;
}

/// Returns the moduli of a cubic crystal in Voigt notation.
Eigen::MatrixXd cubic(double c11, double c12, double c44) {
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(6, 6);
  c.topLeftCorner(3, 3).setConstant(c12);
  c.diagonal() << c11, c11, c11, c44, c44, c44;
  return c;
}

TEST(Lattice, FaceCentredCubicSpheresHaveTheirClosedForm) {
  Mat<3> cell;
  cell << 0.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 0.0;
  const Packing<3> packing = bravais(std::sqrt(0.5) * cell);
  ASSERT_EQ(packing.contacts.size(), 6u);
  ModuliOptions options;
  options.strains = StrainSet::full;
  const Moduli m = elastic_moduli(packing, options);
  // Every sphere is a centre of symmetry, so displacements are affine. The volume per sphere is d^3/sqrt(2). With a sum
  // over the 6 branch directions n of a sphere, C_abcd = (sqrt(2)/d) sum [(K_N - K_T) n_a n_b n_c n_d + K_T (n_a n_c
  // delta_bd + ...)/4].
  const double unit = std::sqrt(2.0) / kSpacing;
  const Eigen::MatrixXd closed = cubic(unit * (kN + kT), unit * 0.5 * (kN - kT), unit * 0.5 * (kN + kT));
  EXPECT_LT((m.C - closed).cwiseAbs().maxCoeff(), kRounding);
  expect_within_bound(m, closed);
  EXPECT_EQ(m.n_mechanisms, 0);
}

TEST(Lattice, CubicSpheresHaveTheirClosedForm) {
  const Packing<3> packing = bravais(Mat<3>::Identity());
  ModuliOptions options;
  options.strains = StrainSet::full;
  const Moduli m = elastic_moduli(packing, options);
  Eigen::VectorXd expected(6);
  expected << kN, kN, kN, kT / 2.0, kT / 2.0, kT / 2.0;
  const Eigen::MatrixXd closed = Eigen::MatrixXd(expected.asDiagonal()) / kSpacing;
  expect_within_bound(m, closed);
  EXPECT_LT((m.C - closed).cwiseAbs().maxCoeff(), kRounding);
  EXPECT_NEAR(m.B, kN / (3.0 * kSpacing), kRounding);
  EXPECT_NEAR(m.bounds.B_voigt, m.B, kRounding);
  EXPECT_NEAR(m.bounds.B_reuss, m.B, kRounding);
}

TEST(Chain, OfThreeDisksIsASeriesOfSpringsThatHoldsOnlyItsOwnLine) {
  Packing<2> packing = test::chain_across(3, kSpacing, 2.0, test::elastic_law(kN, kT, 0.0));
  ASSERT_EQ(packing.contacts.size(), 3u);
  double compliance = 0.0;
  for (int c = 0; c < 3; ++c) {
    packing.contacts[c].kn = 1.0 + c;
    compliance += 1.0 / (1.0 + c);
  }
  const Moduli m = elastic_moduli(packing, {});
  EXPECT_NEAR(m.C(0, 0), 3.0 * kSpacing / (2.0 * compliance), kRounding);
  EXPECT_EQ(m.C(1, 1), 0.0);
  EXPECT_EQ(m.n_coupled_mechanisms, 1);
  // The transverse motion has 3 displacements and 3 rotations. Of these 6 motions, 3 stretch the springs and 1 is a
  // translation, so 2 mechanisms remain. The strain of the cell across the chain is a third mechanism.
  EXPECT_EQ(m.n_mechanisms, 3);
  EXPECT_EQ(m.n_negative, 0);
  EXPECT_EQ(m.B_S, 0.0);
  EXPECT_FALSE(m.warnings.empty());
}

TEST(Chain, WithRollingStiffnessOnlyTheCellIsAMechanism) {
  const Moduli m = elastic_moduli(test::chain_across(5, kSpacing, 2.0, test::elastic_law(kN, kT, kR)), {});
  EXPECT_NEAR(m.C(0, 0), kN * kSpacing / 2.0, kRounding);
  EXPECT_EQ(m.n_mechanisms, 1);
  EXPECT_EQ(m.n_coupled_mechanisms, 1);
}

}  // namespace
}  // namespace floc
