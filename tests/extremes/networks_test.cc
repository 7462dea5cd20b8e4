#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "floc/base/error.h"
#include "floc/elasticity/moduli.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/tile.h"
#include "support/lattices.h"

/// Tests of contact networks with extreme stiffnesses and shapes, whose moduli have closed forms. Each printed modulus
/// must be correct within its error bound, and the bound must leave significant digits. Otherwise the program must
/// refuse the modulus with a message.
namespace floc {
namespace {

constexpr double kSpacing = 1.3;

Moduli full_moduli(const Packing<2>& packing) {
  ModuliOptions options;
  options.strains = StrainSet::full;
  return elastic_moduli(packing, options);
}

Eigen::Matrix3d isotropic(double B, double G) {
  Eigen::Matrix3d c;
  c << B + G, B - G, 0.0, B - G, B + G, 0.0, 0.0, 0.0, G;
  return c;
}

/// Expects that each modulus agrees with its closed form within its error bound.
/// @param relative  largest accepted error bound, divided by the largest modulus
/// @param given     additional error, because the numbers of the input are rounded
void expect_right(const Moduli& m, const Eigen::MatrixXd& closed, double relative, const std::string& what,
                  double given = 0.0) {
  ASSERT_TRUE(m.C.allFinite()) << what;
  for (int a = 0; a < closed.rows(); ++a)
    for (int b = 0; b < closed.cols(); ++b) {
      EXPECT_LE(std::abs(m.C(a, b) - closed(a, b)), m.C_error(a, b) + given) << what << ", C" << a + 1 << b + 1;
      EXPECT_LE(m.C_error(a, b), relative * closed.cwiseAbs().maxCoeff()) << what << ", C" << a + 1 << b + 1;
    }
}

TEST(Stiffness, OfContactsFromHundredToABillionF0OverA) {
  for (const double kn : {1e2, 1e5, 1e7, 1e9}) {
    const Moduli m = full_moduli(test::triangular(kSpacing, test::elastic_law(kn, 0.7 * kn, 1e-4 * kn)));
    expect_right(m, isotropic(std::sqrt(0.75) * kn, std::sqrt(3.0) / 4.0 * 1.7 * kn), 1e-11,
                 "K_N = " + std::to_string(kn));
  }
}

TEST(Stiffness, AcrossContactsFromAMillionthToAThousandTimesThatAlong) {
  for (const double kt : {1e-6, 1e-3, 1.0, 1e3}) {
    const std::string what = "K_T = " + std::to_string(kt);
    const Law law = test::elastic_law(1.0, kt, 1e-4);
    expect_right(full_moduli(test::triangular(kSpacing, law)),
                 isotropic(std::sqrt(0.75), std::sqrt(3.0) / 4.0 * (1.0 + kt)), 1e-11, what + ", triangular");
    expect_right(full_moduli(test::honeycomb(kSpacing, law)),
                 isotropic(1.0 / std::sqrt(12.0), kt / (std::sqrt(3.0) * (1.0 + kt))), 1e-11,
                 what + ", honeycomb");
  }
}

/// Square frames whose sides are chains of n disks. Under shear, the frames deform only by rolling at the contacts. C33
/// must be proportional to K_R over twelve decades, with errors below its error bound.
TEST(Stiffness, AgainstRollingFromATrillionthToOne) {
  for (const double kr : {1e-12, 1e-8, 1e-4, 1.0})
    for (const int n : {3, 10, 40}) {
      const double R = kSpacing / 2.0;
      const double transverse = (n - 1) / 0.7 + n * (n - 1.0) * (n - 2) * R * R / (3.0 * kr);
      const Moduli m = full_moduli(test::square_frames(n, kSpacing, test::elastic_law(1.0, 0.7, kr)));
      const std::string what = "n = " + std::to_string(n) + ", K_R = " + std::to_string(kr);
      ASSERT_TRUE(m.C.allFinite()) << what;
      EXPECT_LE(std::abs(m.C(2, 2) - 0.5 / transverse), m.C_error(2, 2)) << what;
      EXPECT_LE(std::abs(m.C(0, 0) - 1.0 / (n - 1)), m.C_error(0, 0)) << what;
      // For the softest frames, C33 cannot be distinguished from zero. It is then printed as zero, and a mechanism is
      // reported.
      if (m.n_coupled_mechanisms > 0) {
        EXPECT_EQ(m.C(2, 2), 0.0) << what;
        EXPECT_LT(kr / (n * n), 1e-14) << what;
        EXPECT_FALSE(m.warnings.empty()) << what;
      } else {
        EXPECT_LE(m.C_error(2, 2), 1e-4 * 0.5 / transverse) << what;
      }
    }
}

TEST(Chain, OfTenThousandDisksHoldsItsOwnLine) {
  const Packing<2> packing = test::chain_across(10000, kSpacing, 2.0, test::elastic_law(1.0, 0.7, 0.03));
  const Moduli m = elastic_moduli(packing, {});
  EXPECT_NEAR(m.C(0, 0), kSpacing / 2.0, std::max(m.C_error(0, 0), 1e-9));
  EXPECT_EQ(m.C(1, 1), 0.0);
  EXPECT_EQ(m.n_coupled_mechanisms, 1);
  EXPECT_EQ(m.n_negative, 0);
}

/// Ten thousand disks that form a tree: each disk is attached at a random angle to an earlier disk. The tree is
/// isostatic and does not percolate. It can therefore be strained without elastic energy, for any stiffness of its
/// contacts.
TEST(Tree, OfTenThousandDisksHoldsNothing) {
  Packing<2> packing;
  packing.law = test::elastic_law(1.0, 0.7, 0.03);
  packing.cell.matrix *= 200.0;
  packing.grains = Grains<2>::with_size(10000);
  packing.grains.radius.assign(10000, 0.5);
  packing.grains.mass.assign(10000, 1.0);
  std::mt19937 engine(5);
  for (int i = 1; i < 10000; ++i) {
    const int stem = std::uniform_int_distribution<int>(std::max(0, i - 50), i - 1)(engine);
    const double angle = std::uniform_real_distribution<double>(0.0, 2.0 * std::numbers::pi)(engine);
    packing.grains.position[i] =
        packing.grains.position[stem] + 0.999 * Vec<2>(std::cos(angle), std::sin(angle));
    Contact<2> c;
    c.i = stem;
    c.j = i;
    packing.contacts.push_back(c);
  }
  refresh_contacts(packing);
  ASSERT_EQ(packing.contacts.size(), 9999u);
  for (const double force : {0.0, 1e-5}) {
    ModuliOptions options;
    // With a tolerance of 0, every contact counts. With the default tolerance, all grains of the tree are rattlers,
    // because there is no adhesion.
    options.force_tolerance = force;
    const Moduli m = elastic_moduli(packing, options);
    EXPECT_EQ(m.B, 0.0);
    EXPECT_EQ(m.G, 0.0);
    EXPECT_EQ(m.n_coupled_mechanisms, 2);
    EXPECT_EQ(m.n_negative, 0);
    EXPECT_FALSE(m.warnings.empty());
  }
}

/// One disk that touches its own images up to a distance of `reach` lattice spacings. For a large `reach`, the disk has
/// hundreds of contacts with its images.
TEST(Lattice, OfOneGrainThatTouchesManyOfItsOwnImagesHasTheSumOverThem) {
  for (const double reach : {1.05, 2.5, 10.2}) {
    Packing<2> packing = test::triangular(kSpacing, test::elastic_law(1.0, 0.7, 0.03));
    packing.grains.radius[0] = 0.5 * reach * kSpacing;
    find_contacts(packing);
    // Sum over all branches, each counted once. The response is affine. C_abcd is the sum of [K_N n_a n_b n_c n_d + K_T
    // (tangential part)] r^2, divided by the area (n: normal, r: branch length).
    double bulk = 0.0, shear = 0.0;
    int n_contacts = 0;
    const int far = static_cast<int>(2.0 * reach) + 2;
    for (int k = -far; k <= far; ++k)
      for (int l = -far; l <= far; ++l) {
        const Vec<2> r = packing.cell.shift({k, l});
        if (r.norm() >= reach * kSpacing || (k == 0 && l == 0)) continue;
        bulk += 0.5 * r.squaredNorm() / 4.0;
        const double cos2 = (r[0] * r[0] - r[1] * r[1]) / r.squaredNorm(),
                     sin2 = 2.0 * r[0] * r[1] / r.squaredNorm();
        shear += 0.5 * r.squaredNorm() / 4.0 * (cos2 * cos2 + 0.7 * sin2 * sin2);
        ++n_contacts;
      }
    ASSERT_EQ(2 * packing.contacts.size(), static_cast<std::size_t>(n_contacts));
    const Moduli m = elastic_moduli(packing, {});
    const double area = packing.cell.volume();
    EXPECT_LE(std::abs(m.B - bulk / area), m.B_error) << reach;
    EXPECT_LE(std::abs(m.G - shear / area), m.G_error) << reach;
    EXPECT_LE(m.B_error, 1e-11 * m.B) << reach;
    EXPECT_EQ(m.n_mechanisms, 0);
  }
}

/// The triangular crystal has equal moduli in a long cell, in a high cell, and in cells so skewed that their sides are
/// nearly parallel.
TEST(Cell, OfAnyShapeHoldsTheSameCrystal) {
  const Packing<2> unit = test::triangular(kSpacing, test::elastic_law(1.0, 0.7, 0.03));
  const Eigen::Matrix3d closed = isotropic(std::sqrt(0.75), std::sqrt(3.0) / 4.0 * 1.7);
  expect_right(full_moduli(tiled<2>(unit, {100, 1})), closed, 1e-9, "100 x 1");
  expect_right(full_moduli(tiled<2>(unit, {1, 100})), closed, 1e-9, "1 x 100");
  for (const int slant : {1, 30, 1000, 1000000}) {
    Packing<2> slanted = tiled<2>(unit, {4, 4});
    slanted.cell.matrix.row(1) += slant * slanted.cell.matrix.row(0);
    find_contacts(slanted);
    ASSERT_EQ(slanted.contacts.size(), 48u) << slant;
    // The longer lattice vector is `slant` cells long. Rounding to doubles changes the vector by up to half a unit in
    // the last place of its length. This change shears the crystal.
    const double sheared = std::numeric_limits<double>::epsilon() * slant;
    expect_right(full_moduli(slanted), closed, 1e-9, "slant " + std::to_string(slant), 4.0 * sheared);
  }
}

TEST(Packing, WithoutContactsHasNoModuliAndSaysSo) {
  Packing<2> packing = test::triangular(kSpacing, test::elastic_law(1.0, 0.7, 0.03));
  packing.contacts.clear();
  const Moduli m = elastic_moduli(packing, {});
  EXPECT_TRUE(m.C.isZero(0.0));
  EXPECT_EQ(m.n_coupled_mechanisms, 2);
  ASSERT_FALSE(m.warnings.empty());
  EXPECT_NE(m.warnings[0].find("moduli along these strains are zero"), std::string::npos);
}

/// Without adhesion, a single contact does not hold a grain in place, so both grains of a pair are rattlers.
TEST(Packing, OfRattlersAloneHasNoModuli) {
  Packing<2> packing = test::chain_across(8, kSpacing, 2.0, test::elastic_law(1.0, 0.7, 0.03));
  packing.cell.matrix(0, 0) *= 2.0;
  for (int i = 0; i < 8; ++i) packing.grains.position[i][0] += kSpacing * (i / 2);
  find_contacts(packing);
  ASSERT_EQ(packing.contacts.size(), 4u);
  const Moduli m = elastic_moduli(packing, {});
  EXPECT_EQ(m.n_rattlers, 8);
  EXPECT_TRUE(m.C.isZero(0.0));
  EXPECT_EQ(m.n_negative, 0);
}

TEST(Packing, OfTwoGrainsAtOnePlaceIsRefused) {
  Packing<2> packing = test::square_frames(3, kSpacing, test::elastic_law(1.0, 0.7, 0.03));
  packing.grains.position[1] = packing.grains.position[0];
  try {
    find_contacts(packing);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "grains 0 and 1: the grains have the same centre: their contact has no direction");
  }
}

TEST(Packing, OfTooManyContactsIsRefused) {
  Packing<2> packing = test::triangular(kSpacing, test::elastic_law(1.0, 0.7, 0.03));
  packing.grains.radius[0] = 100.0;
  try {
    find_contacts(packing);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("a radius or the cell is wrong"), std::string::npos) << e.what();
  }
}

TEST(Packing, OfAGrainVeryMuchLargerThanItsCellIsRefused) {
  Packing<2> packing = test::triangular(kSpacing, test::elastic_law(1.0, 0.7, 0.03));
  packing.grains.radius[0] = 1e6;
  try {
    find_contacts(packing);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("is so small compared with its largest grain"), std::string::npos)
        << e.what();
  }
}

/// A row of small disks lies across the cell, between a disk that is a thousand times larger and the periodic image of
/// this disk. The small disks form a chain of springs. The large disk, the row and the image form another chain. The
/// two chains do not interact.
TEST(Sizes, OfOneToAThousandMeetInOnePacking) {
  constexpr double kLarge = 0.4995, kSmall = 0.000500001, kHeight = 2.0 * (kLarge + kSmall - 1e-9);
  Packing<2> packing;
  packing.law = test::elastic_law(1.0, 0.7, 0.0);
  packing.cell.matrix << 1.0, 0.0, 0.0, kHeight;
  packing.grains = Grains<2>::with_size(1001);
  packing.grains.radius.assign(1001, kSmall);
  packing.grains.mass.assign(1001, 1e-6);
  packing.grains.radius[0] = kLarge;
  packing.grains.mass[0] = 1.0;
  for (int i = 0; i < 1000; ++i) packing.grains.position[i + 1] = {0.001 * i, 0.5 * kHeight};
  find_contacts(packing);
  ASSERT_EQ(packing.contacts.size(), 1002u);
  const Moduli m = elastic_moduli(packing, {});
  EXPECT_LE(std::abs(m.C(0, 0) - 0.001 / kHeight), m.C_error(0, 0));
  EXPECT_LE(std::abs(m.C(1, 1) - 0.5 * kHeight), m.C_error(1, 1));
  EXPECT_LE(m.C_error.maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace floc
