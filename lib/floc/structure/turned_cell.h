#pragma once

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "floc/geometry/lattice_reduction.h"

namespace floc {

/// A periodic cell in the form that Voro++ requires. The cell is rotated so that its lattice vectors are (bx, 0, 0),
/// (bxy, by, 0) and (bxz, byz, bz). Lengths are divided by a unit, about the distance between neighbours, because
/// Voro++ has absolute tolerances for distances of about 1.
struct TurnedCell {
  /// Rotation, or rotation and reflection; the position in Voro++ is turn * position/unit.
  Mat<3> turn = Mat<3>::Identity();
  /// Rotated lattice vectors, one per row (lower triangular, with positive diagonal).
  Mat<3> lattice;
  double unit = 1.0;  ///< unit of length of the rotated cell (length)

  TurnedCell(const Cell<3>& cell, int n_grains) : unit(std::cbrt(cell.volume() / n_grains)) {
    const Mat<3> rows = reduced_lattice(cell).cell.matrix / unit;
    const Eigen::HouseholderQR<Mat<3>> qr(rows.transpose());
    const Mat<3> q = qr.householderQ();
    Mat<3> r = qr.matrixQR().triangularView<Eigen::Upper>();
    Vec<3> sign;
    for (int a = 0; a < 3; ++a) sign[a] = r(a, a) < 0.0 ? -1.0 : 1.0;
    turn = sign.asDiagonal() * q.transpose();
    lattice = (sign.asDiagonal() * r).transpose();
  }

  Vec<3> there(const Vec<3>& x) const { return turn * x / unit; }
  Vec<3> here(const Vec<3>& x) const { return turn.transpose() * x * unit; }

  /// Returns the number of search blocks along an axis. Voro++ is fastest with about kGrainsPerBlock grains in a block.
  int blocks(int axis) const {
    return std::max(1, static_cast<int>(std::ceil(lattice(axis, axis) * std::cbrt(1.0 / kGrainsPerBlock))));
  }
  static constexpr double kGrainsPerBlock = 5.6;
  static constexpr int kMemoryPerBlock = 8;
};

}  // namespace floc
