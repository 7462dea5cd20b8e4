#pragma once

#include <array>
#include <vector>

#include "floc/packing/wall.h"
#include "floc/relaxation/boundary_control.h"
#include "floc/relaxation/interaction.h"
#include "floc/relaxation/kernels/step_kernels.h"

namespace floc {

/// Walls of a packing in motion, integrated like the grains. The load of an axis between walls acts on both
/// walls: a stress p is a force p S inwards, with S the area of the wall, so that p V is the potential of the
/// load [SVI2024]. At a given strain rate each wall moves with half the relative velocity.
template <int Dim>
class WallMotion {
 public:
  explicit WallMotion(std::vector<Wall<Dim>> walls);

  bool empty() const { return walls_.empty(); }
  int size() const { return static_cast<int>(walls_.size()); }
  const std::vector<Wall<Dim>>& walls() const { return walls_; }
  bool bounds(int axis) const { return between_[axis]; }
  /// Distance of the walls of an axis (length), and its rate of change (length/time). @pre bounds(axis)
  double distance(int axis) const { return gap_of(axis, &Wall<Dim>::position); }
  double distance_rate(int axis) const { return gap_of(axis, &Wall<Dim>::velocity); }

  /// View of the walls for the kernels; valid until the walls move.
  WallView<Dim> view() const;

  /// Lists the pairs of each wall, after a new list of the pairs of grains with walls.
  void list_pairs(const PairArrays<Dim>& pairs);
  /// Sums the forces with which the grains push each wall outwards, in the order of its pairs.
  void sum_forces(const Interaction<Dim>& interaction);

  /// Accelerates the walls over half a step by the forces that were summed last.
  /// @param area  area of the walls of each axis (length^(Dim-1))
  void kick(double half_step, const BoundaryControl<Dim>& control, const Vec<Dim>& area);
  void drift(double time_step);
  void stop();
  double twice_kinetic_energy() const;

  /// Largest displacement of a wall from where it was before (length).
  double largest_displacement(const std::vector<Wall<Dim>>& before) const;

 private:
  double gap_of(int axis, double Wall<Dim>::*member) const;
  void set_arrays();

  std::vector<Wall<Dim>> walls_;
  std::vector<std::vector<int>> pairs_of_wall_;
  std::vector<double> force_;  ///< force on each wall, outwards (force)
  std::array<bool, Dim> between_ = {};
  std::array<std::vector<double>, Dim> normal_;
  std::vector<double> level_, level_rate_;
};

}  // namespace floc
