#include "floc/relaxation/cell_motion.h"

#include <gtest/gtest.h>

#include <vector>

namespace floc {
namespace {

Cell<2> square_cell(double side) {
  Cell<2> cell;
  cell.matrix *= side;
  return cell;
}

/// Returns one block of grains at rest. Its contacts have the given virial on both axes.
std::vector<BlockSums<2>> block_with_virial(double virial) {
  BlockSums<2> sums;
  for (int a = 0; a < 2; ++a) sums.virial[a][a] = virial;
  return {sums};
}

TEST(CellMotion, WrapFindsTheImageInTheCell) {
  Cell<2> cell;
  cell.matrix << 10.0, 0.0, 3.0, 8.0;
  const CellMotion<2> motion(cell, {}, BoundaryControl<2>::fixed());
  const Vec<2> before(-1.0, 17.0);
  Vec<2> x = before;
  const Vec<2, int> image = motion.wrap(x);
  EXPECT_EQ(image, (Vec<2, int>(1, -2)));
  EXPECT_EQ(x, before + motion.image_shift(image));
  EXPECT_EQ(x, cell.wrapped(before));
}

TEST(CellMotion, WallsKeepTheirAxisFromWrapping) {
  const std::vector<Wall<2>> walls = {{0, -1, 0.0, 0.0, 1.0}, {0, +1, 10.0, 0.0, 1.0}};
  const CellMotion<2> motion(square_cell(10.0), walls, BoundaryControl<2>::fixed());
  Vec<2> x(-1.0, 12.0);
  EXPECT_EQ(motion.wrap(x), (Vec<2, int>(0, -1)));
  EXPECT_EQ(x, Vec<2>(-1.0, 2.0));
}

TEST(CellMotion, LatticeStaysAtRestWhereTheVirialBalancesTheStress) {
  CellMotion<2> motion(square_cell(10.0), {}, BoundaryControl<2>::normal_stress(Vec<2>::Constant(2.0), 5.0));
  motion.kick(0.1, block_with_virial(200.0));  // equals V Sigma, the volume times the imposed stress
  EXPECT_TRUE(motion.cell().velocity.isZero(0.0));
}

TEST(CellMotion, LatticeIsAcceleratedByWhatTheStressDoesNotBalance) {
  CellMotion<2> motion(square_cell(10.0), {}, BoundaryControl<2>::normal_stress(Vec<2>::Constant(2.0), 5.0));
  motion.kick(0.1, block_with_virial(210.0));
  // In the time dt/2, the rate changes by (W - V Sigma)/(L M) dt/2, with the virial W, the volume V, the imposed stress
  // Sigma, the side L and the mass M of the cell.
  EXPECT_DOUBLE_EQ(motion.cell().velocity(0, 0), 10.0 / 10.0 / 5.0 * 0.1);
  EXPECT_EQ(motion.cell().velocity(0, 1), 0.0);
}

TEST(CellMotion, StrainRampEndsAtItsLengthAndAtRest) {
  BoundaryControl<2> control = BoundaryControl<2>::fixed();
  control.ramp.from = Vec<2>(10.0, 10.0);
  control.ramp.to = Vec<2>(9.0, 10.0);
  control.ramp.duration = 1.0;
  CellMotion<2> motion(square_cell(10.0), {}, control);
  const auto sums = block_with_virial(0.0);
  for (int step = 0; step < 110; ++step) {
    motion.advance_strain_ramp(0.01);
    motion.kick(0.005, sums);
    motion.drift(0.01);
    motion.kick(0.005, sums);
  }
  // The tolerance allows one or two roundings per step.
  EXPECT_NEAR(motion.cell().matrix(0, 0), 9.0, 1e-12);
  EXPECT_EQ(motion.cell().matrix(1, 1), 10.0);
  EXPECT_TRUE(motion.cell().velocity.isZero(1e-12));
}

TEST(CellMotion, StopKeepsTheRatesThatAreImposed) {
  BoundaryControl<2> control = BoundaryControl<2>::fixed();
  control.target[1] = 0.25;
  CellMotion<2> motion(square_cell(10.0), {}, control);
  motion.stop();
  EXPECT_EQ(motion.cell().velocity(0, 0), 0.0);
  EXPECT_EQ(motion.cell().velocity(1, 1), -2.5);
}

}  // namespace
}  // namespace floc
