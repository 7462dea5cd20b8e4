#pragma once

#include <Eigen/Core>
#include <optional>
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
  /// Lattice vectors of a general triclinic box, one per row. If present, they replace the sides and tilts.
  std::optional<Eigen::Matrix3d> general;

  /// Sets one lattice vector of a general triclinic box.
  void set_general(int index, const Eigen::Vector3d& vector);

  /// Returns the matrix whose rows are the lattice vectors of the box.
  Eigen::Matrix3d matrix() const;

  /// Returns the lattice vectors of the box, one list of three components per vector.
  std::vector<std::vector<double>> vectors() const;

  /// Whether LAMMPS accepts this box for a two-dimensional system in which all grains have the coordinate `z`. LAMMPS
  /// requires that `z` is 0 and that the box extends equally far above and below z = 0.
  bool has_mid_plane(double z) const { return z == 0.0 && low[2] == -0.5 * side[2]; }
};

}  // namespace floc
