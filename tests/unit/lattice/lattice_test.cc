#include "floc/lattice/lattice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "floc/base/error.h"

namespace floc {
namespace {

/// Expects that the branches of a lattice agree with the positions and images of its nodes. Each pair of neighbours
/// must occur once, and each node must have six bonds.
void expect_whole(const Lattice<2>& lattice) {
  std::vector<int> degree(lattice.node.size(), 0);
  for (const LatticeBond<2>& b : lattice.bonds) {
    ++degree[b.i], ++degree[b.j];
    const Vec<2> branch = lattice.node[b.j] + lattice.cell.shift(b.image) - lattice.node[b.i];
    EXPECT_LT((branch - b.branch).norm(), 1e-12 * lattice.cell.matrix.norm());
    EXPECT_NEAR(b.branch.norm(), lattice.spacing, 1e-12 * lattice.spacing);
  }
  for (const int d : degree) EXPECT_EQ(d, 6);
  double volume = 0.0;
  for (const double v : lattice.volume) volume += v;
  EXPECT_NEAR(volume / lattice.cell.volume(), 1.0, 1e-12);
  for (const Vec<2>& x : lattice.node) {
    const Vec<2> s = lattice.cell.reduced(x);
    EXPECT_TRUE((s.array() >= 0.0).all() && (s.array() < 1.0).all()) << s.transpose();
  }
}

TEST(TriangularLattice, JoinsEachNodeToItsSixNeighbours) {
  for (const int columns : {1, 2, 5, 12})
    for (const int rows : {2, 4, 10}) expect_whole(triangular_lattice(columns, rows, 0.7));
}

TEST(TriangularLattice, FillsACellToWithinAHundredthOfItsSpacing) {
  for (const double width : {10.0, 13.37, 40.1}) {
    Cell<2> cell;
    cell.matrix = Vec<2>(width, 11.3).asDiagonal();
    const Lattice<2> lattice = triangular_lattice_in(cell, 0.11);
    expect_whole(lattice);
    EXPECT_NEAR(lattice.cell.volume(), cell.volume(), 1e-9);
    EXPECT_NEAR(lattice.spacing / 0.11, 1.0, 0.04);
    const Vec<2> sides = lattice.cell.matrix.diagonal().cwiseQuotient(cell.matrix.diagonal());
    EXPECT_LT(std::abs(sides[0] - 1.0), 4e-3) << width;
  }
}

TEST(TriangularLattice, HasLatticeVectorsAlongThoseOfTheCell) {
  for (const Vec<2>& sides : {Vec<2>(13.37, -11.3), Vec<2>(-13.37, 11.3), Vec<2>(-13.37, -11.3)}) {
    Cell<2> cell;
    cell.matrix = sides.asDiagonal();
    const Lattice<2> lattice = triangular_lattice_in(cell, 0.5);
    expect_whole(lattice);
    for (int a = 0; a < 2; ++a) EXPECT_GT(lattice.cell.matrix(a, a) * sides[a], 0.0);
  }
}

TEST(TriangularLattice, InASkewedCellOrOfABillionNodesIsRefused) {
  Cell<2> cell;
  cell.matrix << 10.0, 0.0, 1.0, 10.0;
  EXPECT_THROW(triangular_lattice_in(cell, 0.1), InputError);
  cell.matrix = Vec<2>(10.0, 10.0).asDiagonal();
  EXPECT_THROW(triangular_lattice_in(cell, 1e-4), InputError);
}

}  // namespace
}  // namespace floc
