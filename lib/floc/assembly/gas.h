#pragma once

#include "floc/assembly/assembly_options.h"
#include "floc/base/random.h"
#include "floc/packing/packing.h"

namespace floc {

/// Above these solid fractions a fluid is too dense for grains to be placed at random without overlap.
inline constexpr double kDensestGasOfDisks = 0.6;
inline constexpr double kDensestGasOfSpheres = 0.49;

/// Diameters of the grains of a scene (length): equally spaced quantiles of its distribution, in random order.
std::vector<double> draw_diameters(const GrainOptions& options, RandomStream& random);

/// Grains at rest without overlap in a square (cubic) cell at the given solid fraction, placed one by one at random,
/// those of an equilibrated gas then shuffled by hard-sphere Monte Carlo moves until their first places are
/// forgotten. Above about 0.4 (0.3 in 3D) they are placed smaller; they grow to size during the moves, or at once,
/// and are then pushed apart, pair by pair, to 1.001 of the contact distance where they overlap.
///
/// @throws InputError if the grains do not reach their size without overlap: the solid fraction is too high.
template <int Dim>
Packing<Dim> make_gas(const GrainOptions& options, const Law& law, double solid_fraction, RandomStream& random,
                      GasKind kind = GasKind::equilibrated);

/// The same in a box with walls, centres a radius or more from them. Velocities have one magnitude, random
/// directions and no total momentum; density times mean squared speed is the kinetic pressure of the box,
/// however taking the momentum out changes the speeds of single grains.
/// @param solid_fraction  of the box; 0: its sides are lengths
/// @throws InputError if the box is too small for a grain, or as make_gas()
template <int Dim>
Packing<Dim> make_boxed_gas(const GrainOptions& options, const Law& law, const BoxOptions& box,
                            double solid_fraction, RandomStream& random, GasKind kind = GasKind::equilibrated);

/// Gives the grains Maxwell velocities: total momentum zero, root mean square of the translational speed
/// `rms_speed` exactly, no spin.
template <int Dim>
void agitate(Packing<Dim>& packing, double rms_speed, RandomStream& random);

}  // namespace floc
