#pragma once

#include <numbers>

#include "floc/scene/scene.h"

namespace floc {

/// Returns the mass of a grain of the given diameter in a scene. If the scene gives no density, a grain of diameter 1
/// has mass 1.
inline double mass_of(const Scene& scene, double diameter) {
  const double unit_volume = scene.dimension == 2 ? std::numbers::pi / 4.0 : std::numbers::pi / 6.0;
  const double cube = scene.dimension == 2 ? diameter * diameter : diameter * diameter * diameter;
  return scene.grains.density.value_or(1.0 / unit_volume) * unit_volume * cube;
}

/// Returns the pull-off force F0 between two grains of the largest diameter of a scene (force); 0 without adhesion.
inline double pull_off_force(const Scene& scene) {
  return scene.law.pull_off_force(0.5 * scene.grains.largest());
}

}  // namespace floc
