#pragma once

#include <optional>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Whether a wall follows the forces on it. A wall of infinite mass moves at its velocity whatever pushes it;
/// at rest it is fixed.
template <int Dim>
bool follows_forces(const Wall<Dim>& wall);

/// The packing moved so that the lower wall of each axis is at zero, where the cell begins: moving walls leave
/// it. Unchanged without walls.
template <int Dim>
Packing<Dim> with_walls_at_cell(Packing<Dim> packing);

/// Area of the walls across an axis (length^(Dim-1)).
template <int Dim>
double wall_area(const Packing<Dim>& packing, int axis);

/// Static normal force with which grains push each wall outwards, in the order of Packing::walls (force).
template <int Dim>
std::vector<double> wall_forces(const Packing<Dim>& packing);

/// Mean pressure of the grains on the two walls of each axis, zero along an axis without walls
/// (force/length^(Dim-1)).
template <int Dim>
Vec<Dim> wall_pressure(const Packing<Dim>& packing);

/// Mean of wall_pressure() over the axes between walls (force/length^(Dim-1)); none without walls.
template <int Dim>
std::optional<double> mean_wall_pressure(const Packing<Dim>& packing);

/// The stress that the boundary is loaded with: the static one and, along each axis between walls, the pressure
/// on them, part of which is borne by the friction of the others (force/length^(Dim-1)).
template <int Dim>
Mat<Dim> load_stress(const Packing<Dim>& packing);

/// The part of the pressure on the walls across each axis that the friction of the walls along it bears: the
/// sum of t_a x_a over their contacts, t the friction on a grain at x, over the volume (force/length^(Dim-1)).
/// At rest the static stress is the pressure less this (docs/physics.md, "Boxes with walls").
template <int Dim>
Vec<Dim> stress_borne_by_friction(const Packing<Dim>& packing);

/// Largest difference between the pressure on a wall that follows its forces and that imposed on its axis
/// (force/length^(Dim-1)); 0 without such walls.
template <int Dim>
double wall_imbalance(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

}  // namespace floc
