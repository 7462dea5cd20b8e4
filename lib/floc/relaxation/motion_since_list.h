#pragma once

#include <array>
#include <vector>

#include "floc/relaxation/cell_motion.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/kernels/step_kernels.h"

namespace floc {

/// How far grains, lattice and walls have moved since the lists of neighbours were built. The motion of the grains
/// is bounded before each step without a look at every grain; where the bound is too wide, it is measured block by
/// block.
template <int Dim>
class MotionSinceList {
 public:
  MotionSinceList(int n_blocks, const CellMotion<Dim>& cell)
      : lattice_(cell.lattice()), walls_(cell.walls().walls()), measured_(n_blocks, 0.0) {}

  /// Begins anew where the bodies are now.
  /// @param skin           that each grain has to itself (length)
  /// @param shortest_skin  no grain has less (length)
  void begin(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell, const std::vector<double>& skin,
             double shortest_skin);
  /// Adds a bound of the motion of a time step. The cell has drifted already, the grains have not.
  /// @param sums  of the blocks of grains after the step before
  void add_step(const CellMotion<Dim>& cell, const std::vector<BlockSums<Dim>>& sums, const Kick<Dim>& kick,
                const Drift<Dim>& drift);
  /// Measures the motion of a block of grains. Threads may measure different blocks at once.
  void measure(int block, const StepKernels<Dim>& kernels, const GrainView<Dim>& grains);
  /// Replaces the bound by what was measured, once all blocks have been.
  void take_measured();
  /// Gives up the bound, so that it serves again only after a measurement.
  void forget();

  /// Largest motion of a grain against the deformation of the lattice, in skins of the grain: a bound, or as
  /// measured.
  double of_grains() const { return of_grains_; }
  /// Largest displacement of a wall (length).
  double of_walls(const WallMotion<Dim>& walls) const { return walls.largest_displacement(walls_); }
  /// Bound of the share by which the deformation of the lattice has shortened any line.
  double shrinking() const;

  /// The grains as kernels receive them.
  GrainView<Dim> view_of(GrainArrays<Dim>& grains) const { return grains.view(x_, inverse_skin_squared_); }
  /// Drops the positions. @pre no step follows
  void release() { x_ = {}; }

 private:
  // When the lists were built:
  std::array<AlignedVector<double>, Dim> x_;    ///< positions of the grains
  AlignedVector<double> inverse_skin_squared_;  ///< of each grain (1/length^2)
  Mat<Dim> lattice_;
  std::vector<Wall<Dim>> walls_;

  Mat<Dim> stretch_ = Mat<Dim>::Identity();  ///< deformation of the lattice since then
  double of_grains_ = 0.0;                   ///< in skins of the grain
  double rounding_ = 0.0;                    ///< what the rounding of a step may add to it
  std::vector<double> measured_;             ///< motion of each block when it was last measured, in skins
};

}  // namespace floc
