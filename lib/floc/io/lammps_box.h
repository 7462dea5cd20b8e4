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

  /// The first `dimension` lattice vectors, with as many components.
  /// @throws InputError naming `place` if a side of them is not positive.
  std::vector<std::vector<double>> lattice(const std::string& place, int dimension) const;
};

}  // namespace floc
