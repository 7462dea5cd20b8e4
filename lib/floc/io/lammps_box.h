#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace floc {

/// Box of LAMMPS (lengths). Its lattice vectors are (lx, 0, 0), (xy, ly, 0), (xz, yz, lz), where `side` = (lx, ly, lz).
/// They begin at the corner `low`.
struct LammpsBox {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d side = Eigen::Vector3d::Zero();
  double xy = 0.0;
  double xz = 0.0;
  double yz = 0.0;

  /// Returns the matrix whose rows are the lattice vectors.
  Eigen::Matrix3d matrix() const;

  /// Lattice vectors (length), one list of three components per vector.
  std::vector<std::vector<double>> vectors() const;

  /// Checks the first `dimension` sides. @throws InputError naming `place` if one of them is not positive
  void require_sides(const std::string& place, int dimension) const;

  /// Whether `z` is 0 and the middle of the box is at z = 0, as LAMMPS requires in two dimensions.
  bool has_mid_plane(double z) const { return z == 0.0 && low[2] == -0.5 * side[2]; }
};

}  // namespace floc
