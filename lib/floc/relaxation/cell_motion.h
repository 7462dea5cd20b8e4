#pragma once

#include <vector>

#include "floc/packing/packing.h"
#include "floc/relaxation/boundary_control.h"
#include "floc/relaxation/interaction.h"
#include "floc/relaxation/kernels/step_kernels.h"
#include "floc/relaxation/wall_motion.h"

namespace floc {

/// Boundary of a packing in motion: the lattice and the walls, moved by velocity Verlet steps, like the grains. Each
/// component of the boundary follows an imposed stress or has an imposed strain rate (BoundaryControl).
///
/// The columns of the lattice matrix are the lattice vectors. This matrix and all other matrices of this class are
/// upper triangular, and diagonal for a rectangular cell. Along an axis between walls, the lattice does not move, since
/// a moving lattice would also move the grains.
template <int Dim>
class CellMotion {
 public:
  CellMotion(const Cell<Dim>& cell, std::vector<Wall<Dim>> walls, const BoundaryControl<Dim>& control);

  const WallMotion<Dim>& walls() const { return walls_; }
  /// Returns the lattice matrix h, whose columns are the lattice vectors (length).
  const Mat<Dim>& lattice() const { return lattice_; }
  /// Returns the cell in the form in which a Packing stores it. The side of an axis between walls is the distance
  /// between the walls.
  Cell<Dim> cell() const;
  /// Whether the lattice vectors, their velocities and the sides are finite.
  bool finite() const;
  /// Returns the shortest side of the boundary (length).
  double shortest_side() const { return sides().cwiseAbs().minCoeff(); }
  /// For each component (a, b) of the lattice matrix: whether it follows a stress.
  const Mat<Dim, bool>& follows_stress() const { return follows_stress_; }

  /// Returns the vector from a grain to its periodic image (length).
  /// @param image  for each lattice vector, the number of times that it is added to the position of the grain
  Vec<Dim> image_shift(const Vec<Dim, int>& image) const;
  /// Moves a position into the cell by lattice vectors, except along axes between walls.
  /// @return the number of lattice vectors along each axis by which the position was moved
  Vec<Dim, int> wrap(Vec<Dim>& position) const;
  /// Returns the boundary in the form in which the force kernels (compiled loops over pairs) read it. The result
  /// contains pointers to the arrays of the walls, which are valid for the lifetime of this object.
  /// @param slip_time  time for which the contact springs are stretched at the present relative velocities (time)
  PairCell<Dim> pair_cell(double slip_time) const;

  /// Lists, for each wall, the pairs of a grain with this wall; to be called after new lists of pairs have been built.
  void list_pairs_of_walls(const PairArrays<Dim>& pairs) { walls_.list_pairs(pairs); }
  /// Sums the forces on each wall; to be called after the forces of the pairs of grains with walls have been computed.
  void sum_forces_on_walls(const Interaction<Dim>& interaction) { walls_.sum_forces(interaction); }

  /// Sets the strain rates of the axes whose lengths change along a strain ramp (StrainRamp), so that these axes have
  /// the lengths of the ramp after the next drift over `time_step`.
  void advance_strain_ramp(double time_step);
  /// Accelerates the lattice and the walls over half a time step.
  /// @param sums  contributions of the blocks of grains to the virial and the momentum flux
  void kick(double half_step, const std::vector<BlockSums<Dim>>& sums);
  /// Moves the lattice and the walls over a time step. Returns the coefficients of the change of the positions of
  /// grains in this step.
  Drift<Dim> drift(double time_step);
  /// Returns the coefficients of the acceleration of the grains over half a step. The coefficients include the drag on
  /// the peculiar velocities that results from the deformation of the lattice.
  Kick<Dim> kick_of_grains(double half_step) const;

  /// Returns twice the kinetic energy of the components of the lattice that follow a stress; 0 if no component follows
  /// a stress.
  double twice_kinetic_energy_of_lattice() const;
  /// Sets the velocities of all components that follow a stress to zero, and keeps imposed strain rates.
  void stop();

 private:
  Vec<Dim> sides() const;
  /// Whether component (a, b) of the boundary belongs to the lattice; otherwise it belongs to a wall.
  bool belongs_to_lattice(int a, int b) const { return !walls_.bounds(a) && !walls_.bounds(b); }
  Mat<Dim> lattice_force(const std::vector<BlockSums<Dim>>& sums) const;
  void kick_lattice(double half_step, const std::vector<BlockSums<Dim>>& sums);
  void kick_walls(double half_step);
  void impose_rates();

  BoundaryControl<Dim> control_;
  WallMotion<Dim> walls_;
  Mat<Dim> lattice_, lattice_rate_;  ///< lattice matrix h (length) and its rate h' (length/time)
  /// Velocity gradient h' h^-1 of the lattice matrix h, in the middle of the last time step (1/time).
  Mat<Dim> strain_rate_;
  Mat<Dim, bool> follows_stress_ = Mat<Dim, bool>::Constant(false);
  double time_ = 0.0;  ///< simulated time since this object was made (time)
};

}  // namespace floc
