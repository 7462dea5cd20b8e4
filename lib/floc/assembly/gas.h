#pragma once

#include "floc/assembly/assembly_options.h"
#include "floc/base/random.h"
#include "floc/packing/packing.h"

namespace floc {

/// Largest solid fraction of a gas of disks, and of a gas of spheres. At higher solid fractions, grains cannot be
/// placed at random without overlap.
inline constexpr double kDensestGasOfDisks = 0.6;
inline constexpr double kDensestGasOfSpheres = 0.49;

/// Returns the diameters of the grains of a scene (length): equally spaced quantiles of the distribution of diameters,
/// in random order. A list of diameters keeps its order.
std::vector<double> draw_diameters(const GrainOptions& options, RandomStream& random);

/// Makes a gas: grains at rest in a square (3D: cubic) cell, at random positions without overlap.
/// 1. The grains are placed one by one. If the solid fraction is above about 0.4 (3D: 0.3), the grains get smaller
///    diameters first and then grow to their final diameters.
/// 2. In a gas of kind `equilibrated`, the grains grow while they make random Monte Carlo moves as hard spheres. The
///    moves continue until the positions of the grains have no correlation with the positions at which they were
///    placed.
/// 3. In a gas of kind `sequential_addition`, the grains grow in one step. If two grains overlap after this step, they
///    are pushed apart until their centres have a distance of 1.001 times the sum of the radii.
///
/// @throws InputError if the solid fraction is so high that the grains cannot grow to their final diameters without
/// overlap
template <int Dim>
Packing<Dim> make_gas(const GrainOptions& options, const Law& law, double solid_fraction, RandomStream& random,
                      GasKind kind = GasKind::equilibrated);

/// Makes a gas in a box with walls, by the method of make_gas(). Grains do not overlap walls. The grains get velocities
/// of equal magnitude and random direction. The mean velocity is subtracted, so that the speeds differ slightly.
/// Finally all velocities are multiplied by one factor, such that the mass density times the mean squared speed equals
/// BoxOptions::kinetic_pressure.
/// @param solid_fraction  solid fraction of the gas in the box; if it is 0, the numbers in `box.sides` are lengths
/// @throws InputError if the box is too small for the largest grain, or if the grains cannot be placed without overlap
template <int Dim>
Packing<Dim> make_boxed_gas(const GrainOptions& options, const Law& law, const BoxOptions& box,
                            double solid_fraction, RandomStream& random, GasKind kind = GasKind::equilibrated);

/// Gives the grains velocities of equal magnitude in random directions, subtracts the mean velocity, and scales all
/// velocities such that mass density times mean squared speed equals the kinetic pressure.
template <int Dim>
void send_off(Packing<Dim>& packing, double kinetic_pressure, RandomStream& random);

/// Gives the grains random velocities (Maxwell distribution) with zero total momentum and the root mean square speed
/// `rms_speed` (length/time). Their spins are not changed.
template <int Dim>
void agitate(Packing<Dim>& packing, double rms_speed, RandomStream& random);

}  // namespace floc
