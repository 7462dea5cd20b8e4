#pragma once

#include <optional>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns whether the forces on a wall move the wall. A wall of infinite mass keeps its velocity under any forces; it
/// is fixed if its velocity is zero.
template <int Dim>
bool follows_forces(const Wall<Dim>& wall);

/// Returns the number of walls normal to an axis that forces move: 0, 1 (a lid above a floor) or 2. It is 0 if one end
/// of the axis is open, and without walls.
template <int Dim>
int n_moving_walls(const Packing<Dim>& packing, int axis);

/// Returns a packing that is shifted so that the lower wall of each axis lies at zero, where the cell begins. The shift
/// is needed because moving walls drift away from zero. A packing without walls is returned unchanged.
template <int Dim>
Packing<Dim> with_walls_at_cell(Packing<Dim> packing);

/// Moves each open end to the surface of the outermost grain. The side of the cell along this axis becomes the distance
/// between the two ends. A grain with corners counts as its circumscribed circle or sphere.
template <int Dim>
void fit_open_ends(Packing<Dim>& packing);

/// Returns the area of each of the two walls that are normal to an axis (length^(Dim-1)).
template <int Dim>
double wall_area(const Packing<Dim>& packing, int axis);

/// Returns the static normal force of the grains on each wall, positive outwards, in the order of Packing::walls
/// (force).
template <int Dim>
std::vector<double> wall_forces(const Packing<Dim>& packing);

/// Returns the mean pressure of the grains on the two walls of each axis (force/length^(Dim-1)). If one end of an axis
/// is open, the result is the pressure on its only wall; it is zero along an axis without walls.
template <int Dim>
Vec<Dim> wall_pressure(const Packing<Dim>& packing);

/// Returns the mean of wall_pressure() over the axes that have a wall (force/length^(Dim-1)), which those open at both
/// ends have not; absent without walls.
template <int Dim>
std::optional<double> mean_wall_pressure(const Packing<Dim>& packing);

/// Returns, for each axis with walls, the coordinate that does not move while the distance between the two walls
/// changes (length). It is the position of a wall that forces do not move if they move the wall opposite, such as the
/// floor below a lid, and the middle between two walls that both move or both stay. Zero along an axis without walls.
template <int Dim>
Vec<Dim> strain_origin(const Packing<Dim>& packing);

/// Returns the stress that balances the load on the boundary (force/length^(Dim-1)). It is the static stress, except
/// that for each axis with a wall the diagonal component is the pressure that does work if the distance between the
/// two walls changes (strain_origin()): the mean pressure on both walls, or the pressure on the only wall that forces
/// move. If one end of the axis is open, it is the pressure on the only wall. At rest, the static stress and the mean
/// pressure on the walls differ by stress_borne_by_friction().
template <int Dim>
Mat<Dim> load_stress(const Packing<Dim>& packing);

/// For each axis a, returns the part of the pressure on the two walls normal to a that is balanced by friction on the
/// other walls (force/length^(Dim-1)). This part is the sum of t_a (x_a - c_a) over the contacts with walls, divided by
/// the volume of the cell, where t is the friction force on a grain, x the contact point, and c the middle between the
/// two walls. If one end of the axis is open, c is this end. At rest and without gravity along the axis, the static
/// stress is the pressure minus this part (docs/physics.md, "Boxes with walls"). Zero along an axis without walls.
template <int Dim>
Vec<Dim> stress_borne_by_friction(const Packing<Dim>& packing);

/// Returns the largest difference between the pressure on a wall and the stress imposed on its axis
/// (force/length^(Dim-1)). Only walls that can move under forces count; the result is 0 if there are no such walls.
template <int Dim>
double wall_imbalance(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

}  // namespace floc
