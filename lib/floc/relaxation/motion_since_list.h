#pragma once

#include <array>
#include <vector>

#include "floc/relaxation/cell_motion.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/kernels/step_kernels.h"

namespace floc {

/// Motion of grains, lattice and walls since the lists of neighbours were built. In each time step, only an upper bound
/// of the motion of the grains is updated, which needs no loop over the grains. When this bound becomes too large, the
/// motion itself is measured, one block of grains at a time.
template <int Dim>
class MotionSinceList {
 public:
  MotionSinceList(int n_blocks, const CellMotion<Dim>& cell)
      : lattice_(cell.lattice()), walls_(cell.walls().walls()), measured_(n_blocks, 0.0) {}

  /// Begins to measure the motion from the present positions of the bodies, for which new lists are built.
  /// @param skin  distance that each grain may move before new lists have to be built (length)
  /// @param shortest_skin  lower bound of the distances in `skin` (length)
  void begin(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell, const std::vector<double>& skin,
             double shortest_skin);
  /// Adds an upper bound of the motion in a time step. This function has to be called after the drift of the cell and
  /// before the drift of the grains.
  /// @param sums  sums of each block of grains (with upper bounds of speeds) after the previous step
  /// @param fall  change of the speed of a free grain by gravity over half a time step (length/time)
  void add_step(const CellMotion<Dim>& cell, const std::vector<BlockSums<Dim>>& sums, const Kick<Dim>& kick,
                const Drift<Dim>& drift, double fall);
  /// Measures the motion of a block of grains since the lists were built. Several threads may measure different blocks
  /// at the same time.
  void measure(int block, const StepKernels<Dim>& kernels, const GrainView<Dim>& grains);
  /// Replaces the upper bound of the motion of the grains by the largest motion measured in any block.
  /// @pre all blocks have been measured
  void take_measured();
  /// Sets the upper bound of the motion of the grains to infinity, so that the motion has to be measured before the
  /// lists are used again.
  void forget();

  /// Returns an upper bound of the motions of all grains relative to the deformation of the lattice. The motion of each
  /// grain is divided by its skin.
  double of_grains() const { return of_grains_; }
  /// Returns the largest displacement of a wall since the lists were built (length).
  double of_walls(const WallMotion<Dim>& walls) const { return walls.largest_displacement(walls_); }
  /// Returns an upper bound of the relative shortening of distances that the deformation of the lattice has caused
  /// since the lists were built.
  double shrinking() const;

  /// Returns pointers to the arrays of the grains for kernels (compiled loops over grains or pairs). The pointers are
  /// valid until the next lists are built.
  GrainView<Dim> view_of(GrainArrays<Dim>& grains) const { return grains.view(x_, inverse_skin_squared_); }
  /// Frees the positions at which the lists were built.
  /// @pre no step follows
  void release() { x_ = {}; }

 private:
  // The following members describe the state at the time when the lists were built.
  /// Positions of the grains when the lists were built (length).
  std::array<AlignedVector<double>, Dim> x_;
  /// The number 1/s^2 for each grain, where s is its skin: the distance that the grain may move (1/length^2).
  AlignedVector<double> inverse_skin_squared_;
  Mat<Dim> lattice_;
  std::vector<Wall<Dim>> walls_;

  /// Deformation gradient of the lattice since the lists were built.
  Mat<Dim> stretch_ = Mat<Dim>::Identity();
  /// Upper bound of the displacements of the grains, where each displacement is divided by the skin of the grain.
  double of_grains_ = 0.0;
  /// Upper bound of the rounding error of a displacement in one step, divided by the smallest skin of a grain.
  double rounding_ = 0.0;
  /// For each block: largest motion of a grain when the motion was last measured, divided by the skin of the grain.
  std::vector<double> measured_;
};

}  // namespace floc
