#pragma once

#include <string>
#include <vector>

#include "floc/elasticity/moduli.h"
#include "floc/scene/numerical_settings.h"
#include "floc/scene/scene.h"

namespace floc {

/// One value of one parameter, everything else as in the scene. The reference has the finest value of each.
struct StudiedSetting {
  std::string parameter;  ///< "tolerance", "time_step", ...; "together" if several are changed
  std::string value;      ///< value as a user would write it
  NumericalSettings numerical;
  double rate_cap_factor = 1.0;   ///< factor of every cap on the strain rate
  double cell_mass_factor = 1.0;  ///< factor of the mass of the cell on the load path
  int n_grains = 0;               ///< 0: as in the scene
  ModuliOptions moduli;

  bool is_reference() const { return parameter == "strict"; }
  /// Whether only the moduli differ: the path is that of the settings of the scene.
  bool is_moduli_level() const { return parameter == "moduli"; }
  /// Whether the number of grains differs, so that only means can be compared.
  bool is_other_size() const { return n_grains != 0; }
};

/// Returns the finest settings: forces to 1e-8, beyond which absolute positions do not resolve them, a quarter of the
/// default time step, and twice the patience.
NumericalSettings strict_settings();

/// Returns all settings that a study of this scene compares: the reference first, then those that matter most. Two
/// settings are not varied on their own: "power control", which is the dynamic finish, and the precision of the force
/// loop, which is always double.
std::vector<StudiedSetting> studied_settings(const Scene& scene);

}  // namespace floc
