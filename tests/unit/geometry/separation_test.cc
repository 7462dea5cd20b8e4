#include "floc/geometry/separation.h"

#include <gtest/gtest.h>

#include "floc/geometry/lattice_reduction.h"

namespace floc {
namespace {

TEST(Separation, OfFarPlacesAndImagesIsExact) {
  Cell<2> cell;
  cell.matrix << 41.3, 0.0, 7.1, 39.9;
  const Vec<2> x(0.3, 39.7), low(0x1p-70, -0x1p-60);
  const Vec<2, int> image(-25000000, 31);
  const DoubleDoubleVec<2> from = double_double<2>(x, low);
  const DoubleDoubleVec<2> there = displaced<2>(from, cell, image);
  const DoubleDoubleVec<2> back = displaced<2>(there, cell, Vec<2, int>(-image));
  // At a distance of 1e9, the last bit of the second double is 1e9 * 2^-106.
  for (int a = 0; a < 2; ++a) EXPECT_NEAR((back[a] - from[a]).rounded(), 0.0, 1e9 * 0x1p-104);
  const DoubleDoubleVec<2> r = difference<2>(there, from);
  for (int a = 0; a < 2; ++a)
    EXPECT_NEAR((r[a] - exact_product(-25000000.0, cell.matrix(0, a)) - exact_product(31.0, cell.matrix(1, a)))
                    .rounded(),
                0.0, 1e9 * 0x1p-104);
}

/// The branch (3, -4) has exactly the length 5. The computed gap must therefore be right to its last digit, even if the
/// gap is very small.
TEST(Separation, GivesGapsToTheirOwnLastDigit) {
  const DoubleDoubleVec<2> r = double_double<2>(Vec<2>(3.0, -4.0), Vec<2>::Zero());
  EXPECT_EQ(surface_gap<2>(r, 2.0, 3.0), 0.0);
  for (const double overlap : {0x1p-10, 0x1p-30, 0x1p-50})
    EXPECT_NEAR(surface_gap<2>(r, 2.0, 3.0 + overlap) / -overlap, 1.0, 4e-16) << overlap;
  // This branch is shorter by 2^-80. The leading doubles of its coordinates cannot represent this difference.
  const DoubleDoubleVec<2> nearer = double_double<2>(Vec<2>(3.0, -4.0), Vec<2>(-0.6 * 0x1p-80, 0.8 * 0x1p-80));
  EXPECT_NEAR(surface_gap<2>(nearer, 2.0, 3.0) / -0x1p-80, 1.0, 1e-7);
}

template <int Dim>
void expect_reduced(const Cell<Dim>& short_cell, const Mat<Dim, std::int64_t>& slant) {
  Cell<Dim> given;
  given.matrix = slant.template cast<double>() * short_cell.matrix;
  const ReducedLattice<Dim> lattice = reduced_lattice(given);
  EXPECT_FALSE(lattice.is_original);
  EXPECT_NEAR(std::abs(lattice.combination.template cast<double>().determinant()), 1.0, 1e-6);
  const double scale = given.matrix.cwiseAbs().maxCoeff();
  const Mat<Dim> combined = lattice.combination.template cast<double>() * given.matrix;
  EXPECT_LT((combined - lattice.cell.matrix).cwiseAbs().maxCoeff(), 1e-13 * scale * scale);
  for (int a = 0; a < Dim; ++a)
    EXPECT_LE(lattice.cell.matrix.row(a).norm(), 1.001 * short_cell.matrix.rowwise().norm().maxCoeff());
}

TEST(LatticeReduction, FindsTheShortVectorsOfASlantedLattice) {
  Cell<2> plane;
  plane.matrix << 4.0, 0.5, -1.0, 3.0;
  Mat<2, std::int64_t> slant;
  slant << 1, 0, 1000, 1;
  expect_reduced<2>(plane, slant);
  slant << 7, 3, 2, 1;
  expect_reduced<2>(plane, slant);
  Cell<3> space;
  space.matrix << 4.0, 0.5, 0.1, -1.0, 3.0, 0.2, 0.3, -0.4, 5.0;
  Mat<3, std::int64_t> slant3;
  slant3 << 1, 0, 0, 50, 1, 0, -20, 30, 1;
  expect_reduced<3>(space, slant3);
}

TEST(LatticeReduction, LeavesShortLatticesAsTheyAre) {
  Cell<2> skewed;
  skewed.matrix << 9.0, 0.0, 3.0, 7.0;
  EXPECT_TRUE(reduced_lattice(skewed).is_original);
  EXPECT_EQ(reduced_lattice(skewed).cell.matrix, skewed.matrix);
}

}  // namespace
}  // namespace floc
