#pragma once

#include <array>
#include <vector>

#include "floc/relaxation/cell_motion.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/kernels/step_kernels.h"

namespace floc {

/// Motion of grains, lattice and walls since the lists of neighbours were built. In each time step, an upper bound of
/// the motion of the grains is updated without a pass over the grains. When this bound becomes too large, the motion is
/// measured, one block of grains at a time.
template <int Dim>
class MotionSinceList {
 public:
  MotionSinceList(int n_blocks, const CellMotion<Dim>& cell)
      : lattice_(cell.lattice()), walls_(cell.walls().walls()), measured_(n_blocks, 0.0) {}

  /// Begins to measure the motion, from the present positions of the bodies, at which new lists are built.
  /// @param skin  distance that each grain may move before new lists have to be built (length)
  /// @param shortest_skin  lower bound of the distances in `skin` (length)
  void begin(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell, const std::vector<double>& skin,
             double shortest_skin);
  /// Adds an upper bound of the motion in a time step. It has to be called after the drift of the cell and before the
  /// drift of the grains.
  /// @param sums  contributions of the blocks of grains (speeds and forces) after the previous step
  /// @param fall  change of the speed of a free grain by gravity over half a time step (length/time)
  void add_step(const CellMotion<Dim>& cell, const std::vector<BlockSums<Dim>>& sums, const Kick<Dim>& kick,
                const Drift<Dim>& drift, double fall);
  /// Measures the motion of a block of grains since the lists were built. Several threads may do this at once for
  /// different blocks.
  void measure(int block, const StepKernels<Dim>& kernels, const GrainView<Dim>& grains);
  /// Replaces the upper bound of the motion of the grains by the largest motion measured in any block.
  /// @pre all blocks have been measured
  void take_measured();
  /// Sets the upper bound of the motion of the grains to infinity, so that the motion has to be measured before the
  /// lists are used again.
  void forget();

  /// Returns an upper bound of the motion of the grains relative to the deformation of the lattice, where the motion of
  /// each grain is divided by its skin.
  double of_grains() const { return of_grains_; }
  /// Returns the largest displacement of a wall since the lists were built (length).
  double of_walls(const WallMotion<Dim>& walls) const { return walls.largest_displacement(walls_); }
  /// Returns an upper bound of the relative shortening of any line by the deformation of the lattice since the lists
  /// were built.
  double shrinking() const;

  /// Returns pointers to the arrays of the grains, in the form that kernels (compiled loops over grains or pairs) read.
  /// They are valid until the next lists are built.
  GrainView<Dim> view_of(GrainArrays<Dim>& grains) const { return grains.view(x_, inverse_skin_squared_); }
  /// Frees the positions at which the lists were built.
  /// @pre no step follows
  void release() { x_ = {}; }

 private:
  // The following members hold the state at the time when the lists were built.
  /// Positions of the grains when the lists were built (length).
  std::array<AlignedVector<double>, Dim> x_;
  /// One over the squared skin of each grain, the distance that it may move (1/length^2).
  AlignedVector<double> inverse_skin_squared_;
  Mat<Dim> lattice_;
  std::vector<Wall<Dim>> walls_;

  /// Deformation gradient of the lattice since the lists were built.
  Mat<Dim> stretch_ = Mat<Dim>::Identity();
  /// Upper bound of the displacements of the grains, each divided by the skin of the grain.
  double of_grains_ = 0.0;
  /// Upper bound of the rounding error that one step adds to the displacement of a grain, divided by the smallest skin
  /// of a grain.
  double rounding_ = 0.0;
  /// Largest motion of a grain in each block when the motion was last measured, divided by the skin of the grain.
  std::vector<double> measured_;
};

}  // namespace floc
