#pragma once

#include "floc/planning/price_model.h"

namespace floc {

/// Runs a few small samples of a scene with the settings of the scene, and measures the processor time and the scatter
/// between samples. The growth of the processor time with the number of grains is determined from samples of two sizes.
/// If the limit leaves enough time, the growth is determined instead from one more sample with up to twenty times as
/// many grains. The error that the settings cause is not measured.
/// @param limit  processor time that the pilot may take (s)
/// @throws InputError if the scene starts from a saved state, so that its number of grains cannot be changed, or if a
/// sample is not complete within the limit
/// @throws NoResult if a sample does not converge
PilotResult run_pilot(const Scene& scene, double limit);

}  // namespace floc
