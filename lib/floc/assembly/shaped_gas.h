#pragma once

#include <cstdint>
#include <vector>

#include "floc/assembly/gas.h"

namespace floc {

/// Returns grains with the shapes of a scene, at the origin and at rest, with random orientations. The shapes are
/// assigned to the grains in random order, such that all shapes have equal numbers of grains (up to a difference of
/// one). The radius of a grain is the radius of its circumscribed circle or sphere: half the diameter of the grain. The
/// mass is the volume of the grain times the density of the scene. If the scene has no density, the density is chosen
/// such that a disk or sphere of diameter 1 has mass 1.
/// @param options  options of the grains of a scene, including their shapes
/// @param diameter  diameter of each grain (length)
/// @param seed  seed of the run, which determines the shapes and the orientations
/// @throws InputError if draw_shapes() throws it
template <int Dim>
Grains<Dim> shaped_grains(const GrainOptions& options, const std::vector<double>& diameter, std::uint64_t seed);

/// Returns the volume of all grains divided by the volume of their circumscribed circles or spheres.
template <int Dim>
double share_of_bounding_balls(const Grains<Dim>& grains);

/// Returns the largest solid fraction of a gas of these grains. At a higher solid fraction, their circumscribed circles
/// or spheres cannot be placed at random without overlap.
template <int Dim>
double densest_gas(const Grains<Dim>& grains);

/// Makes a gas of grains with shapes in a square (3D: cubic) cell. The circumscribed circles or spheres of the grains
/// are placed by make_gas(), so the grains do not overlap in any orientation.
/// @param options  options of the grains of a scene, including their shapes
/// @param solid_fraction  volume of the grains divided by the volume of the cell
/// @param seed  seed of the run, which determines the shapes and the orientations
/// @param random  random stream for the diameters and the positions
/// @throws InputError if the solid fraction is above densest_gas(), or if shaped_grains() or make_gas() throws it
template <int Dim>
Packing<Dim> make_shaped_gas(const GrainOptions& options, const Law& law, double solid_fraction,
                             std::uint64_t seed, RandomStream& random, GasKind kind);

/// Makes a gas of grains with shapes in a box with walls. The circumscribed circles or spheres of the grains are placed
/// by make_boxed_gas(); the grains get velocities from send_off().
/// @param solid_fraction  volume of the grains divided by the volume of the box; if it is 0, the numbers in `box.sides`
/// are lengths
/// @throws InputError if the solid fraction is above densest_gas(), or if shaped_grains() or make_boxed_gas() throws it
template <int Dim>
Packing<Dim> make_boxed_shaped_gas(const GrainOptions& options, const Law& law, const BoxOptions& box,
                                   double solid_fraction, std::uint64_t seed, RandomStream& random,
                                   GasKind kind);

}  // namespace floc
