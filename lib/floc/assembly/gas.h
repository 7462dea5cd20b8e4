#pragma once

#include "floc/assembly/assembly_options.h"
#include "floc/base/random.h"
#include "floc/packing/packing.h"

namespace floc {

/// Largest solid fraction of a gas of disks or spheres. At higher solid fractions, grains cannot be placed at
/// random without overlap.
inline constexpr double kDensestGasOfDisks = 0.6;
inline constexpr double kDensestGasOfSpheres = 0.49;

/// Returns the diameters of the grains of a scene (length): equally spaced quantiles of the distribution, in
/// random order.
std::vector<double> draw_diameters(const GrainOptions& options, RandomStream& random);

/// Places grains at rest without overlap in a square (cubic) cell at the given solid fraction, one by one at
/// random. The grains of an equilibrated gas are then shuffled by hard-sphere Monte Carlo moves until they have
/// lost any correlation with their first positions. At solid fractions above about 0.4 (0.3 in 3D), grains are
/// placed with smaller diameters. In an equilibrated gas they grow to their final diameters during the Monte
/// Carlo moves. Otherwise they grow at once, and pairs that overlap are pushed apart to 1.001 times the contact
/// distance.
///
/// @throws InputError if the grains cannot grow to their final diameters without overlap because the solid
/// fraction is too high
template <int Dim>
Packing<Dim> make_gas(const GrainOptions& options, const Law& law, double solid_fraction, RandomStream& random,
                      GasKind kind = GasKind::equilibrated);

/// Places grains without overlap in a box with walls, by the method of make_gas(), with centres at least a
/// radius away from the walls. Velocities are drawn with one magnitude in random directions. The mean velocity
/// is then subtracted so that the total momentum is zero, which changes the speeds of single grains a little.
/// The velocities are scaled so that density times mean squared speed equals the kinetic pressure of the box.
/// @param solid_fraction  solid fraction of the box; 0: `box.sides` are lengths
/// @throws InputError if the box is too small for a grain, or if the grains cannot be placed without overlap
template <int Dim>
Packing<Dim> make_boxed_gas(const GrainOptions& options, const Law& law, const BoxOptions& box,
                            double solid_fraction, RandomStream& random, GasKind kind = GasKind::equilibrated);

/// Gives the grains random velocities (Maxwell distribution) with zero total momentum and a root mean square
/// speed of exactly `rms_speed` (length/time). Spins are not changed.
template <int Dim>
void agitate(Packing<Dim>& packing, double rms_speed, RandomStream& random);

}  // namespace floc
