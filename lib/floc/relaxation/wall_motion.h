#pragma once

#include <array>
#include <vector>

#include "floc/packing/wall.h"
#include "floc/relaxation/boundary_control.h"
#include "floc/relaxation/interaction.h"
#include "floc/relaxation/kernels/step_kernels.h"

namespace floc {

/// Walls of a packing in motion, moved by velocity Verlet steps, like the grains. A stress p imposed on an axis between
/// two walls exerts an inward force p S on each wall, with the area S of a wall. The potential energy of this load is
/// p V, with the volume V of the box [SVI2024]. If a strain rate is imposed on the axis, the two walls move in opposite
/// directions at equal speeds.
template <int Dim>
class WallMotion {
 public:
  explicit WallMotion(std::vector<Wall<Dim>> walls);

  bool empty() const { return walls_.empty(); }
  int size() const { return static_cast<int>(walls_.size()); }
  const std::vector<Wall<Dim>>& walls() const { return walls_; }
  bool bounds(int axis) const { return between_[axis]; }
  /// Distance between the two walls of an axis (length), and rate of change of this distance (length/time).
  /// @pre bounds(axis)
  double distance(int axis) const { return gap_of(axis, &Wall<Dim>::position); }
  double distance_rate(int axis) const { return gap_of(axis, &Wall<Dim>::velocity); }

  /// Returns pointers to the arrays of the walls, in the form that force kernels (compiled loops over pairs) read;
  /// valid for the lifetime of this object.
  WallView<Dim> view() const;

  /// Lists, for each wall, the pairs of a grain with this wall; to be called after new lists of pairs have been built.
  void list_pairs(const PairArrays<Dim>& pairs);
  /// Sums the forces with which grains push each wall outwards, in the order of the pairs that list_pairs() has listed.
  void sum_forces(const Interaction<Dim>& interaction);

  /// Accelerates the walls over half a time step by the forces of the last call of sum_forces().
  /// @param area  area of the walls of each axis (length^(Dim-1))
  void kick(double half_step, const BoundaryControl<Dim>& control, const Vec<Dim>& area);
  void drift(double time_step);
  void stop();
  double twice_kinetic_energy() const;

  /// Returns the largest displacement of a wall from its position in `before` (length).
  double largest_displacement(const std::vector<Wall<Dim>>& before) const;

 private:
  double gap_of(int axis, double Wall<Dim>::*member) const;
  void set_arrays();

  std::vector<Wall<Dim>> walls_;
  std::vector<std::vector<int>> pairs_of_wall_;
  std::vector<double> force_;  ///< outward force of the grains on each wall (force)
  std::array<bool, Dim> between_ = {};
  std::array<std::vector<double>, Dim> normal_;
  std::vector<double> level_, level_rate_;
};

}  // namespace floc
