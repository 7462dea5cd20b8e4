#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace floc {

/// A box of LAMMPS: lattice vectors (lx, 0, 0), (xy, ly, 0), (xz, yz, lz) from the corner `low` (length).
struct LammpsBox {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d side = Eigen::Vector3d::Zero();
  double xy = 0.0;
  double xz = 0.0;
  double yz = 0.0;

  /// Rows are the lattice vectors.
  Eigen::Matrix3d matrix() const;

  /// Lattice vectors (length), one list of three components per vector.
  std::vector<std::vector<double>> vectors() const;

  /// @throws InputError naming `place` if one of the first `dimension` sides is not positive
  void require_sides(const std::string& place, int dimension) const;

  /// Whether `z` is 0 and this is the middle of the box, as LAMMPS requires in two dimensions.
  bool has_mid_plane(double z) const { return z == 0.0 && low[2] == -0.5 * side[2]; }
};

}  // namespace floc
