#pragma once

#include <string>
#include <vector>

#include "floc/elasticity/moduli.h"
#include "floc/scene/numerical_settings.h"
#include "floc/scene/scene.h"

namespace floc {

/// One value of one parameter, everything else as in the scene. The reference has the finest value of each.
struct StudiedSetting {
  std::string parameter;  ///< "tolerance", "time_step", ...; "together" where several are changed
  std::string value;      ///< as a user would write it
  NumericalSettings numerical;
  double rate_cap_factor = 1.0;   ///< on every cap of the strain rate
  double cell_mass_factor = 1.0;  ///< on the mass of the cell, on the load path alone
  int n_grains = 0;               ///< 0: those of the scene
  ModuliOptions moduli;

  bool is_reference() const { return parameter == "strict"; }
  /// The path is that of the scene's own settings; only what is computed from its states differs.
  bool is_moduli_level() const { return parameter == "moduli"; }
  /// Another system, compared in the mean only.
  bool is_other_size() const { return n_grains != 0; }
};

/// Finest settings: forces to 1e-8, beyond which absolute positions do not carry them, a time step that is a
/// quarter of the default, and twice the patience.
NumericalSettings strict_settings();

/// All settings that a study of this scene compares, the reference first, then those that matter most. "power
/// control" is what the dynamic finish does, and the force loop has double precision only, so neither is varied
/// on its own.
std::vector<StudiedSetting> studied_settings(const Scene& scene);

}  // namespace floc
