#pragma once

#include <string>
#include <vector>

#include "floc/elasticity/moduli.h"
#include "floc/scene/numerical_settings.h"
#include "floc/scene/scene.h"

namespace floc {

/// A setting that a study examines: one parameter has another value than in the scene, everything else is as in the
/// scene. Only in the reference (the strictest settings) every parameter has its strictest value.
struct StudiedSetting {
  /// name of the parameter: "tolerance", "time_step", ...; "together" if several are changed
  std::string parameter;
  std::string value;  ///< value of the parameter, as a user would write it
  NumericalSettings numerical;
  double rate_cap_factor = 1.0;   ///< factor by which every cap on the strain rate of the cell is multiplied
  double cell_mass_factor = 1.0;  ///< factor by which the mass of the cell on the load path is multiplied
  int n_grains = 0;               ///< number of grains; 0 for the number of the scene
  ModuliOptions moduli;

  bool is_reference() const { return parameter == "strict"; }
  /// Whether only the computation of the moduli differs, so that the path is that of the settings of the scene.
  bool is_moduli_level() const { return parameter == "moduli"; }
  /// Whether the number of grains differs from that of the scene, so that only means over samples can be compared.
  bool is_other_size() const { return n_grains != 0; }
};

/// Returns the strictest settings: a tolerance of 1e-8, because rounded positions do not resolve smaller forces; a time
/// step of about a quarter of the default; and twice the default patience.
NumericalSettings strict_settings();

/// Returns all settings that a study of this scene compares: the strictest settings first, then the others in the order
/// of their importance. Two settings are not varied separately: power control (setting all velocities to zero when the
/// kinetic energy falls), because it is part of the finish "dynamic", and the precision of the computation of forces,
/// because it is always double.
std::vector<StudiedSetting> studied_settings(const Scene& scene);

}  // namespace floc
