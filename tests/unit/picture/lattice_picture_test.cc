#include "floc/picture/lattice_picture.h"

#include <gtest/gtest.h>

#include "floc/lattice/irregular_lattice.h"

namespace floc {
namespace {

Lattice<3> small_lattice() {
  Cell<3> cell;
  cell.matrix.diagonal() << 5.0, 4.0, 6.0;
  return irregular_lattice(cell, {1.0, 0.35, 3});
}

/// Returns the same lattice with other lattice vectors: integer multiples of earlier lattice vectors are added to the
/// last two vectors.
Lattice<3> slanted(Lattice<3> lattice) {
  Mat<3>& matrix = lattice.cell.matrix;
  matrix.row(2) += matrix.row(1) - matrix.row(0);
  matrix.row(1) += matrix.row(0);
  for (Vec<3>& x : lattice.node) x = lattice.cell.wrapped(x);
  return lattice;
}

/// Returns a picture with a different value for each node, and with every bond drawn as a crack.
LatticePicture<3> picture_of(const Lattice<3>& lattice) {
  LatticePicture<3> picture;
  for (int k = 0; k < lattice.n_nodes(); ++k)
    picture.color.push_back({k / static_cast<double>(lattice.n_nodes()), 0.5, (k % 7) / 7.0});
  for (int b = 0; b < static_cast<int>(lattice.bonds.size()); ++b) picture.faces.push_back(b);
  return picture;
}

TEST(LatticePicture, IsTheSameWhicheverCellSpansTheLattice) {
  const Lattice<3> straight = small_lattice();
  const Lattice<3> skewed = slanted(straight);
  ASSERT_FALSE(skewed.cell.rectangular());
  for (int axis = 0; axis < 3; ++axis) {
    LatticeSheetOptions options;
    options.cut = {.axis = axis, .at = 0.3};
    EXPECT_EQ(draw_lattice(straight, picture_of(straight), options),
              draw_lattice(skewed, picture_of(skewed), options))
        << "across axis " << axis;
  }
}

TEST(LatticePicture, ShowsCellsThatShearSkewsButNoneThatAreTurned) {
  Cell<3> cell;
  cell.matrix(2, 0) = 0.4;
  EXPECT_TRUE(can_be_drawn(cell));
  cell.matrix(0, 2) = 0.1;
  EXPECT_FALSE(can_be_drawn(cell));
}

}  // namespace
}  // namespace floc
