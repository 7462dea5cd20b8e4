#include "floc/geometry/cell.h"

#include <gtest/gtest.h>

namespace floc {
namespace {

/// Cell with the lattice vectors (4, 0) and (1, 2) and an area of 8.
Cell<2> skewed() {
  Cell<2> cell;
  cell.matrix << 4, 0, 1, 2;
  return cell;
}

TEST(Cell, VolumeIsTheDeterminantWhateverTheHandedness) {
  EXPECT_DOUBLE_EQ(skewed().volume(), 8.0);
  Cell<2> flipped = skewed();
  flipped.matrix.row(0).swap(flipped.matrix.row(1));
  EXPECT_DOUBLE_EQ(flipped.volume(), 8.0);
  Cell<3> box;
  box.matrix << 2, 0, 0, 1, 3, 0, 5, 7, 4;
  EXPECT_DOUBLE_EQ(box.volume(), 24.0);
}

TEST(Cell, RowsAreTheLatticeVectors) {
  EXPECT_EQ(skewed().shift({1, 0}), Vec<2>(4, 0));
  EXPECT_EQ(skewed().shift({0, 1}), Vec<2>(1, 2));
  EXPECT_EQ(skewed().shift({-1, 3}), Vec<2>(-1, 6));
}

TEST(Cell, ReducedCoordinatesCountLatticeVectors) {
  const Vec<2> s = skewed().reduced({0.25 * 4 + 0.5 * 1, 0.5 * 2});
  EXPECT_NEAR(s[0], 0.25, 1e-16);
  EXPECT_NEAR(s[1], 0.5, 1e-16);
}

TEST(Cell, WrappingMovesByWholeImagesIntoTheCell) {
  const Cell<2> cell = skewed();
  const Vec<2> inside = cell.shift({0, 0}) + 0.75 * Vec<2>(4, 0) + 0.5 * Vec<2>(1, 2);
  for (const Vec<2, int>& image : {Vec<2, int>(0, 0), Vec<2, int>(2, -3), Vec<2, int>(-5, 1)}) {
    const Vec<2> wrapped = cell.wrapped(inside + cell.shift(image));
    EXPECT_NEAR((wrapped - inside).norm(), 0.0, 1e-14);
  }
}

TEST(Cell, OnlyADiagonalLatticeIsRectangular) {
  EXPECT_FALSE(skewed().rectangular());
  Cell<3> box;
  box.matrix.diagonal() << 1, 2, 3;
  EXPECT_TRUE(box.rectangular());
  box.matrix(2, 0) = 1e-300;
  EXPECT_FALSE(box.rectangular());
}

TEST(Cell, RateIsTheVelocityGradientOfTheLattice) {
  // A lattice point moves with the lattice vectors. Its velocity is therefore the rate (velocity gradient) times its
  // position.
  Cell<2> cell = skewed();
  cell.velocity << 0.5, 0.25, -1.0, 2.0;
  for (const Vec<2>& image : {Vec<2>(1, 0), Vec<2>(0, 1), Vec<2>(2, -3)}) {
    const Vec<2> point = cell.matrix.transpose() * image;
    const Vec<2> velocity = cell.velocity.transpose() * image;
    EXPECT_NEAR((cell.rate() * point - velocity).norm(), 0.0, 1e-14);
  }
}

}  // namespace
}  // namespace floc
