#pragma once

#include "floc/planning/price_model.h"

namespace floc {

/// Runs a few small samples of a scene with its own settings, and measures the processor time and the scatter between
/// samples. The samples have two sizes, from which the growth of the processor time with the number of grains follows;
/// if the limit leaves time, one sample with up to twenty times as many grains determines the growth in their place.
/// The error that the settings cause is not measured.
/// @param limit  processor time that the pilot may take (s)
/// @throws InputError if the scene starts from a saved state, so that its number of grains cannot be changed, or if a
/// sample is not complete within the limit
/// @throws NoResult if a sample does not converge
PilotResult run_pilot(const Scene& scene, double limit);

}  // namespace floc
