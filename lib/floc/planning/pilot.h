#pragma once

#include "floc/planning/price_model.h"

namespace floc {

/// Largest processor time of a pilot, as a share of the budget.
inline constexpr double kShareOfPilot = 0.2;

/// Runs a few small samples of a scene with the settings of the scene, and measures the processor time and the scatter
/// between samples. The growth of the processor time with the number of grains is determined from samples of two sizes.
/// If the limit leaves enough time, the growth is determined instead from one more sample with up to twenty times as
/// many grains. The error that the settings cause is not measured.
/// @param limit  processor time that the pilot may take (s)
/// @param prices  table of prices that applies to the scene; null if there is none
/// @throws InputError if the scene starts from a saved state, so that its number of grains cannot be changed, or if the
/// samples are not complete within the limit. If their expected time clearly exceeds the limit, nothing is run. The
/// message names a budget that is expected to be sufficient
/// @throws NoResult if a sample does not converge
PilotResult run_pilot(const Scene& scene, double limit, const PriceTable* prices = nullptr);

}  // namespace floc
