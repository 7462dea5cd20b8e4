#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/elasticity/moduli.h"
#include "floc/lattice/relaxed_springs.h"
#include "floc/prices/numerical_settings.h"
#include "floc/scene/scene.h"

namespace floc {

/// Numerical settings of the lattice of cemented grains (`floc lattice`).
struct LatticeSettings {
  double nodes_a_diameter = 15.0;  ///< number of lattice nodes per mean diameter of the grains
  LatticeMethod method = LatticeMethod::automatic;
  /// tolerance of the solution: largest net force on a node, divided by the load
  double tolerance = 1e-10;
};

/// One variant of a scene that a study compares. One parameter (rarely several) differs from the scene; all others have
/// the values of the scene. In the reference (the strictest settings), every parameter has its strictest value.
struct StudiedSetting {
  /// name of the changed parameter: "tolerance", "time_step", ...; "together" if several are changed
  std::string parameter;
  std::string value;  ///< value of the changed parameter as text, such as "0.1" or "5 times"
  NumericalSettings numerical;
  ContactDynamicsOptions contact_dynamics;  ///< settings of rigid grains
  CompactionEnd compaction;                 ///< end of a compaction between walls
  double rate_cap_factor = 1.0;   ///< factor by which every cap on the strain rate of the cell is multiplied
  double cell_mass_factor = 1.0;  ///< factor by which the mass of the cell is multiplied on the load path
  double steps_factor = 1.0;      ///< factor by which the numbers of steps per decade are multiplied
  int n_grains = 0;               ///< number of grains; 0: number of grains of the scene
  ModuliOptions moduli;
  /// settings of the lattice; present only in a study of cemented grains
  std::optional<LatticeSettings> lattice;

  bool is_reference() const { return parameter == "strict"; }
  /// Whether every study includes this variant; true for the strictest settings and for the scene as it is.
  bool is_compared_with() const { return is_reference() || parameter == "scene"; }
  /// Whether the variant differs from the scene only in the method for the elastic moduli. Such a variant needs no run
  /// of its own: its moduli are computed for the states of the reference.
  bool is_moduli_level() const { return parameter == "moduli"; }
  /// Whether the variant has another number of grains, other steps of the load path, softer springs or other masses
  /// than the reference. If so, its states cannot be compared with single states of the reference, but only by means
  /// over all states under equal loads.
  bool has_other_states() const { return n_grains != 0 || steps_factor != 1.0 || numerical.changes_path(); }
};

/// Declaration of a parameter that a study varies: the scenes to which it applies, and the function that adds one
/// variant of the scene for each value of the parameter.
struct DeclaredSetting {
  const char* parameter;
  bool (*applies)(const Scene&);
  void (*add)(const Scene&, const StudiedSetting& base, std::vector<StudiedSetting>& list);
};

/// Returns all parameters that a study varies, the most important first.
const std::vector<DeclaredSetting>& declared_settings();

/// Whether a study may change the number of grains of a scene: true if the packings are made from a gas and the scene
/// does not list the diameter of each grain.
bool has_any_number_of_grains(const Scene& scene);

/// Keeps, in the list of a study, only the variants of the named parameters, the strictest settings, and the scene as
/// it is.
/// @param names  parameters to keep; empty: all
/// @throws InputError if no variant in the list belongs to one of the named parameters
void keep_parameters(const std::vector<std::string>& names, std::vector<StudiedSetting>& settings);

/// Returns the strictest numerical settings of elastic grains: a tolerance of 1e-8, about a quarter of the default time
/// step, and twice the default patience (NumericalSettings::patience). With a smaller tolerance, forces would be lost
/// in the rounding errors of the positions.
NumericalSettings strict_settings();

/// Returns all variants of a scene that a study compares: the strictest settings first, then the scene as it is, then
/// the values of each declared parameter. Two choices are not varied separately. Power control (stopping all grains
/// when the kinetic energy falls) is part of the finish "dynamic". The precision of forces is always double.
std::vector<StudiedSetting> studied_settings(const Scene& scene);

/// Returns the variants in a study of the lattice of cemented grains: the finest lattice with the strictest tolerance
/// first, then the default lattice of `floc lattice`, then other numbers of nodes per diameter, tolerances, methods and
/// numbers of grains.
std::vector<StudiedSetting> lattice_settings(const Scene& scene);

/// Returns the tolerance of a setting: the tolerance of equilibria or, in a study of a lattice, the tolerance of the
/// solution of the lattice.
double tolerance_of(const StudiedSetting& setting);

/// Returns the time step of a setting: NumericalSettings::time_step or, for rigid grains,
/// ContactDynamicsOptions::time_step, each in its own unit. The result is NaN in a study of a lattice.
double time_step_of(const Scene& scene, const StudiedSetting& setting);

double patience_of(const StudiedSetting& setting);

/// Returns the keyword for the method by which a setting completes equilibria: for elastic grains the value of
/// equilibrium.finish, for rigid grains the value of dynamics.finish, for a lattice the method of its solution.
std::string finish_of(const Scene& scene, const StudiedSetting& setting);

/// Returns the options for running a scene with a setting of the study, on one thread.
RunOptions run_options(const Scene& scene, const StudiedSetting& setting, std::uint64_t seed);

}  // namespace floc
