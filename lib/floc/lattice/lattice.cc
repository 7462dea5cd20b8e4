#include "floc/lattice/lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "floc/base/error.h"

namespace floc {
namespace {

/// Distance between neighbouring rows of nodes, divided by the distance between neighbouring nodes in a row.
constexpr double kRowHeight = 0.5 * std::numbers::sqrt3;
/// Largest number of nodes of a lattice.
constexpr double kMostNodes = 1e8;

/// Replaces the lattice vector of an axis by its opposite. The nodes are shifted into the new cell, and the lattice
/// remains the same.
void reverse_axis(int axis, Lattice<2>& lattice) {
  lattice.cell.matrix(axis, axis) = -lattice.cell.matrix(axis, axis);
  for (Vec<2>& x : lattice.node) x[axis] += lattice.cell.matrix(axis, axis);
  for (LatticeBond<2>& b : lattice.bonds) b.image[axis] = -b.image[axis];
}

}  // namespace

Lattice<2> triangular_lattice(int columns, int rows, double spacing) {
  assert(columns >= 1 && rows >= 2 && rows % 2 == 0);
  Lattice<2> out;
  out.spacing = spacing;
  out.cell.matrix = Vec<2>(columns * spacing, rows * kRowHeight * spacing).asDiagonal();
  const int n = columns * rows;
  out.volume.assign(n, kRowHeight * spacing * spacing);
  out.node.reserve(n);
  out.bonds.reserve(3 * static_cast<std::size_t>(n));
  // Each node has a hexagonal cell with sides of spacing/sqrt(3), and six bonds. The bonds to the right, to the upper
  // right and to the upper left are listed with the node. The other three bonds are listed with its neighbours.
  const double facet = spacing / std::numbers::sqrt3;
  const Vec<2> steps[] = {
      {spacing, 0.0}, {0.5 * spacing, kRowHeight * spacing}, {-0.5 * spacing, kRowHeight * spacing}};
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      // Odd rows are shifted by half a spacing. All rows are also shifted by a quarter of the spacing, so that no node
      // lies on the border of the cell.
      const bool shifted = r % 2 == 1;
      out.node.emplace_back((c + (shifted ? 0.75 : 0.25)) * spacing, (r + 0.5) * kRowHeight * spacing);
      const int to_column[] = {c + 1, shifted ? c + 1 : c, shifted ? c : c - 1};
      for (int b = 0; b < 3; ++b) {
        const int row = b == 0 ? r : r + 1;
        const int wound = to_column[b] < 0 ? -1 : to_column[b] / columns;
        const Vec<2, int> image(wound, row / rows);
        const int j = row % rows * columns + to_column[b] - wound * columns;
        out.bonds.push_back({r * columns + c, j, image, steps[b], 0.5 * steps[b], facet});
      }
    }
  return out;
}

Lattice<2> triangular_lattice_in(const Cell<2>& cell, double spacing) {
  if (!cell.rectangular())
    throw InputError("",
                     "the cell is not rectangular, and a triangular lattice fits only into a rectangular cell");
  const double width = std::abs(cell.matrix(0, 0)), height = std::abs(cell.matrix(1, 1));
  if (width * height / (kRowHeight * spacing * spacing) > kMostNodes)
    throw InputError(
        "",
        fmt::format("a spacing of {:.3g} is too small: the lattice would have more than 1e8 nodes", spacing));
  /// Largest relative difference between a number of columns that is tried and the width of the cell divided by the
  /// spacing.
  constexpr double kTried = 0.03;
  const double asked = width / spacing;
  int best_columns = 1, best_rows = 2;
  double best = std::numeric_limits<double>::infinity();
  const int first = std::max(1, static_cast<int>(std::round(asked * (1.0 - kTried))));
  const int last = std::max(first, static_cast<int>(std::round(asked * (1.0 + kTried))));
  for (int columns = first; columns <= last; ++columns) {
    const int rows =
        2 * std::max(1, static_cast<int>(std::round(0.5 * height * columns / (width * kRowHeight))));
    const double misfit = std::abs(std::log(rows * kRowHeight * width / (columns * height)));
    // Among lattices that fit equally well, the one with the spacing nearest to the given spacing is chosen.
    const double off = misfit + 1e-6 * std::abs(columns - asked);
    if (off < best) best = off, best_columns = columns, best_rows = rows;
  }
  const double n = static_cast<double>(best_columns) * best_rows;
  Lattice<2> out = triangular_lattice(best_columns, best_rows, std::sqrt(width * height / (n * kRowHeight)));
  for (int axis = 0; axis < 2; ++axis)
    if (cell.matrix(axis, axis) < 0.0) reverse_axis(axis, out);
  return out;
}

}  // namespace floc
