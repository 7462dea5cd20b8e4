#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace floc {

/// Simulation box of LAMMPS; all members are lengths. The box begins at the corner `low` and is spanned by the lattice
/// vectors (lx, 0, 0), (xy, ly, 0) and (xz, yz, lz), where (lx, ly, lz) = `side`.
struct LammpsBox {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d side = Eigen::Vector3d::Zero();
  double xy = 0.0;
  double xz = 0.0;
  double yz = 0.0;

  /// Returns the matrix whose rows are the lattice vectors of the box.
  Eigen::Matrix3d matrix() const;

  /// Returns the lattice vectors of the box, one list of three components per vector.
  std::vector<std::vector<double>> vectors() const;

  /// Checks that the first `dimension` sides of the box are positive.
  /// @param place  place of the box in its file, for messages
  /// @throws InputError if one of these sides is not positive
  void require_sides(const std::string& place, int dimension) const;

  /// Whether LAMMPS accepts the box and grains at height `z` as two-dimensional: `z` is 0, and the box extends equally
  /// far above and below z = 0.
  bool has_mid_plane(double z) const { return z == 0.0 && low[2] == -0.5 * side[2]; }
};

}  // namespace floc
