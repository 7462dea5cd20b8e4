#pragma once

#include <optional>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Whether a wall follows the forces on it. A wall of infinite mass does not: it keeps its velocity, and is
/// fixed if that is zero.
template <int Dim>
bool follows_forces(const Wall<Dim>& wall);

/// Shifts a packing so that the lower wall of each axis is at zero, where the cell begins; walls that move
/// drift away from there. Without walls the packing is unchanged.
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

/// Mean of wall_pressure() over the axes between walls (force/length^(Dim-1)); absent without walls.
template <int Dim>
std::optional<double> mean_wall_pressure(const Packing<Dim>& packing);

/// Stress that the load on the boundary balances (force/length^(Dim-1)): the static stress, with the pressure
/// on the walls as the diagonal component of each axis between walls. At rest the two differ by
/// stress_borne_by_friction().
template <int Dim>
Mat<Dim> load_stress(const Packing<Dim>& packing);

/// Part of the pressure on the walls across each axis a that the friction of the walls along the axis bears
/// (force/length^(Dim-1)): the sum of t_a x_a over their contacts, over the volume, where t is the friction on
/// a grain at x. At rest the static stress is the pressure less this part (docs/physics.md, "Boxes with
/// walls").
template <int Dim>
Vec<Dim> stress_borne_by_friction(const Packing<Dim>& packing);

/// Largest difference between the pressure on a wall and the stress imposed on its axis, over the walls that
/// follow forces (force/length^(Dim-1)); 0 without such walls.
template <int Dim>
double wall_imbalance(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

}  // namespace floc
