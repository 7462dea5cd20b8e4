#pragma once

#include <vector>

#include "floc/packing/packing.h"
#include "floc/relaxation/boundary_control.h"
#include "floc/relaxation/interaction.h"
#include "floc/relaxation/kernels/step_kernels.h"
#include "floc/relaxation/wall_motion.h"

namespace floc {

/// The boundary of a packing in motion: the lattice and the walls, moved by the same scheme as the grains. Each
/// component of the boundary follows a stress or a strain rate (BoundaryControl).
///
/// The lattice vectors are the columns of the matrices here, which are upper triangular, and diagonal for a
/// rectangular cell. The lattice rests along an axis that lies between walls, so that the grains do not follow
/// its deformation there.
template <int Dim>
class CellMotion {
 public:
  CellMotion(const Cell<Dim>& cell, std::vector<Wall<Dim>> walls, const BoundaryControl<Dim>& control);

  const WallMotion<Dim>& walls() const { return walls_; }
  /// Matrix h, whose columns are the lattice vectors (length).
  const Mat<Dim>& lattice() const { return lattice_; }
  /// Cell in the form that packings store, with the distance of the walls as the side of each axis between
  /// walls.
  Cell<Dim> cell() const;
  /// Whether the lattice, its rate and the sides are finite.
  bool finite() const;
  /// Shortest side of the boundary (length).
  double shortest_side() const { return sides().cwiseAbs().minCoeff(); }
  /// Components (a, b) of the lattice that follow a stress.
  const Mat<Dim, bool>& follows_stress() const { return follows_stress_; }

  /// Displacement of an image (length).
  Vec<Dim> image_shift(const Vec<Dim, int>& image) const;
  /// Moves a position into the cell, except along axes between walls.
  /// @return the image by which it was moved
  Vec<Dim, int> wrap(Vec<Dim>& position) const;
  /// Boundary as the kernels of pairs read it. The view of the walls is valid for the lifetime of this object.
  /// @param slip_time  time over which the present velocities are added to the springs (time)
  PairCell<Dim> pair_cell(double slip_time) const;

  /// Lists the pairs of each wall, after a new list of the pairs of grains with walls.
  void list_pairs_of_walls(const PairArrays<Dim>& pairs) { walls_.list_pairs(pairs); }
  /// Sums the forces on the walls, after the forces of their pairs have been computed.
  void sum_forces_on_walls(const Interaction<Dim>& interaction) { walls_.sum_forces(interaction); }

  /// Sets the strain rates of the axes that follow a strain ramp, so that a drift over a time step brings them
  /// to the position of the ramp at the end of the step.
  void advance_strain_ramp(double time_step);
  /// Accelerates the lattice and the walls over half a step. @param sums  of the blocks of grains
  void kick(double half_step, const std::vector<BlockSums<Dim>>& sums);
  /// Moves the lattice and the walls by a time step, and returns how this step deforms the positions of the grains.
  Drift<Dim> drift(double time_step);
  /// Acceleration of the grains over half a step, with the drag of the present deformation of the lattice.
  Kick<Dim> kick_of_grains(double half_step) const;

  /// Twice the kinetic energy of the components that follow a stress; 0 where none does.
  double twice_kinetic_energy_of_lattice() const;
  /// Stops everything that follows a stress, and keeps the rates that are imposed.
  void stop();

 private:
  Vec<Dim> sides() const;
  /// Whether a component of the boundary belongs to the lattice, and not to walls.
  bool belongs_to_lattice(int a, int b) const { return !walls_.bounds(a) && !walls_.bounds(b); }
  Mat<Dim> lattice_force(const std::vector<BlockSums<Dim>>& sums) const;
  void kick_lattice(double half_step, const std::vector<BlockSums<Dim>>& sums);
  void kick_walls(double half_step);
  void impose_rates();

  BoundaryControl<Dim> control_;
  WallMotion<Dim> walls_;
  Mat<Dim> lattice_, lattice_rate_;  ///< h and h'
  Mat<Dim> strain_rate_;             ///< velocity gradient h' h^-1 at mid-step
  Mat<Dim, bool> follows_stress_ = Mat<Dim, bool>::Constant(false);
  double time_ = 0.0;  ///< since this object was made
};

}  // namespace floc
