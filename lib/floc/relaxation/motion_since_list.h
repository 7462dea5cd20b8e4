#pragma once

#include <array>
#include <vector>

#include "floc/relaxation/cell_motion.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/kernels/step_kernels.h"

namespace floc {

/// Motion of grains, lattice and walls since the lists of neighbours were built. An upper bound of the motion
/// of the grains is updated in each step without a pass over the grains; where the bound is too large, the
/// motion is measured block by block.
template <int Dim>
class MotionSinceList {
 public:
  MotionSinceList(int n_blocks, const CellMotion<Dim>& cell)
      : lattice_(cell.lattice()), walls_(cell.walls().walls()), measured_(n_blocks, 0.0) {}

  /// Begins anew where the bodies are now.
  /// @param skin           distance that each grain may move before the next lists (length)
  /// @param shortest_skin  lower bound of these distances (length)
  void begin(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell, const std::vector<double>& skin,
             double shortest_skin);
  /// Adds a bound of the motion of a time step. The cell has drifted already, the grains have not.
  /// @param sums  of the blocks of grains after the step before
  void add_step(const CellMotion<Dim>& cell, const std::vector<BlockSums<Dim>>& sums, const Kick<Dim>& kick,
                const Drift<Dim>& drift);
  /// Measures the motion of a block of grains. Threads may measure different blocks at once.
  void measure(int block, const StepKernels<Dim>& kernels, const GrainView<Dim>& grains);
  /// Replaces the bound by the largest motion of the blocks. @pre all blocks have been measured
  void take_measured();
  /// Sets the bound to infinity, so that the motion has to be measured before the lists are used again.
  void forget();

  /// Bound of the motion of the grains relative to the deformation of the lattice, each in skins of the grain.
  double of_grains() const { return of_grains_; }
  /// Largest displacement of a wall (length).
  double of_walls(const WallMotion<Dim>& walls) const { return walls.largest_displacement(walls_); }
  /// Upper bound of the relative shortening of any line by the deformation of the lattice.
  double shrinking() const;

  /// The grains as kernels receive them. The view stays valid until the next lists.
  GrainView<Dim> view_of(GrainArrays<Dim>& grains) const { return grains.view(x_, inverse_skin_squared_); }
  /// Drops the positions. @pre no step follows
  void release() { x_ = {}; }

 private:
  // When the lists were built:
  std::array<AlignedVector<double>, Dim> x_;    ///< positions of the grains
  AlignedVector<double> inverse_skin_squared_;  ///< one over the squared skin of each grain (1/length^2)
  Mat<Dim> lattice_;
  std::vector<Wall<Dim>> walls_;

  Mat<Dim> stretch_ = Mat<Dim>::Identity();  ///< deformation of the lattice since then
  double of_grains_ = 0.0;                   ///< bound, in skins of the grain
  double rounding_ = 0.0;                    ///< bound of the rounding of one step, in skins of the grain
  std::vector<double> measured_;             ///< motion of each block when it was last measured, in skins
};

}  // namespace floc
