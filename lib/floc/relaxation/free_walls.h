#pragma once

#include <Eigen/Core>
#include <vector>

#include "floc/network/tangent_matrix.h"
#include "floc/packing/load_target.h"
#include "floc/packing/packing.h"

namespace floc {

/// Walls that move under a pressure, whose displacements along their axes are unknowns of a Newton iteration. They are
/// the last unknowns, after those of the grains.
template <int Dim>
class FreeWalls {
 public:
  /// @param load  pressure on the walls of each axis
  FreeWalls(const Packing<Dim>& packing, const LoadTarget<Dim>& load);

  int size() const { return static_cast<int>(walls_.size()); }

  /// Returns the displacement of a wall in a change of all unknowns (length); zero for a wall that is not free.
  /// @param wall  index of the wall in Packing::walls
  Vec<Dim> displacement(const Packing<Dim>& packing, int wall, const Eigen::VectorXd& step) const;

  /// Moves the free walls by a change of all unknowns, and open ends to the surface of the outermost grain.
  void move(const Eigen::VectorXd& step, Packing<Dim>& packing) const;

  /// Returns the effect of the displacements on a contact.
  BoundaryColumns<Dim> columns(const NetworkContact<Dim>& contact) const;

  /// Returns the net force on each free wall along its axis (force): that of the grains less that of the pressure.
  Eigen::VectorXd net_forces(const Packing<Dim>& packing) const;

  /// Returns the derivatives of the forces of the pressures with respect to the displacements, with the sign of a
  /// stiffness. The force on a wall is proportional to its area, and so to the distances between the walls of the other
  /// axes.
  Eigen::MatrixXd load_derivatives(const Packing<Dim>& packing) const;

 private:
  std::vector<int> walls_;  // indices in Packing::walls, ascending
  Vec<Dim> pressure_;
};

}  // namespace floc
