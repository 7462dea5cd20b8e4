#pragma once

#include <string>
#include <vector>

#include "floc/elasticity/moduli.h"
#include "floc/prices/numerical_settings.h"
#include "floc/scene/scene.h"

namespace floc {

/// One variant of a scene that a study compares: one parameter (rarely several) has another value than in the scene,
/// all others are as in the scene. In the reference (the strictest settings), every parameter has its strictest value.
struct StudiedSetting {
  /// name of the changed parameter: "tolerance", "time_step", ...; "together" if several are changed
  std::string parameter;
  std::string value;  ///< value of the changed parameter, as a user would write it
  NumericalSettings numerical;
  double rate_cap_factor = 1.0;   ///< factor by which every cap on the strain rate of the cell is multiplied
  double cell_mass_factor = 1.0;  ///< factor by which the mass of the cell on the load path is multiplied
  int n_grains = 0;               ///< number of grains; 0 if it is that of the scene
  ModuliOptions moduli;

  bool is_reference() const { return parameter == "strict"; }
  /// Whether only the computation of the elastic moduli differs from the scene. No run is then made: the moduli are
  /// computed for the states of the reference.
  bool is_moduli_level() const { return parameter == "moduli"; }
  /// Whether the number of grains differs from that of the scene. States cannot be compared one by one then, only their
  /// means.
  bool is_other_size() const { return n_grains != 0; }
};

/// Returns the strictest numerical settings: a tolerance of 1e-8 (rounding errors of the positions hide smaller
/// forces), about a quarter of the default time step, and twice the default patience.
NumericalSettings strict_settings();

/// Returns all variants of a scene that a study compares: the strictest settings first, then the others in the order of
/// their importance. Two properties are not varied separately: stopping all grains when the kinetic energy falls (power
/// control), because the finish "dynamic" includes it; and the precision in which forces are computed, because it is
/// always double.
std::vector<StudiedSetting> studied_settings(const Scene& scene);

}  // namespace floc
