#pragma once

#include "floc/assembly/assembly_options.h"
#include "floc/base/random.h"
#include "floc/packing/packing.h"

namespace floc {

/// Largest solid fraction of a gas. Above it a fluid is too dense for grains to be placed at random without
/// overlap.
inline constexpr double kDensestGasOfDisks = 0.6;
inline constexpr double kDensestGasOfSpheres = 0.49;

/// Diameters of the grains of a scene (length): equally spaced quantiles of its distribution, in random order.
std::vector<double> draw_diameters(const GrainOptions& options, RandomStream& random);

/// Places grains at rest without overlap in a square (cubic) cell at the given solid fraction, one by one at
/// random. The grains of an equilibrated gas are then shuffled by hard-sphere Monte Carlo moves until they have
/// lost any correlation with their first places. Above a solid fraction of about 0.4 (0.3 in 3D) grains are
/// placed at a smaller size. In an equilibrated gas they grow to their size during the moves; otherwise they
/// grow at once, and pairs that overlap are pushed apart to 1.001 of the contact distance.
///
/// @throws InputError if the grains do not reach their size without overlap: the solid fraction is too high.
template <int Dim>
Packing<Dim> make_gas(const GrainOptions& options, const Law& law, double solid_fraction, RandomStream& random,
                      GasKind kind = GasKind::equilibrated);

/// Places grains without overlap in a box with walls, as make_gas() does, with centres a radius or more from
/// the walls. Velocities are drawn with one magnitude in random directions and then made free of total
/// momentum, which changes the speeds of single grains a little. They are scaled so that density times mean
/// squared speed is the kinetic pressure of the box.
/// @param solid_fraction  of the box; 0: `box.sides` are lengths
/// @throws InputError if the box is too small for a grain, or as make_gas()
template <int Dim>
Packing<Dim> make_boxed_gas(const GrainOptions& options, const Law& law, const BoxOptions& box,
                            double solid_fraction, RandomStream& random, GasKind kind = GasKind::equilibrated);

/// Gives the grains Maxwell velocities with zero total momentum and a root mean square speed of exactly
/// `rms_speed` (length/time). Spins are not changed.
template <int Dim>
void agitate(Packing<Dim>& packing, double rms_speed, RandomStream& random);

}  // namespace floc
