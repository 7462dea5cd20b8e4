#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/assembly/assembly_options.h"
#include "floc/contact/law.h"
#include "floc/loading/load_path.h"

namespace floc {

/// Equilibrium that a run will compute, with the load on the packing in this equilibrium.
struct PlannedEquilibrium {
  std::string branch;  ///< "assembly", or the name of the stage of the load path
  double pressure;     ///< pressure on every axis (stress unit of the scene); unused if `axes` is not empty
  Law law;             ///< contact law at this equilibrium, including the changes that stages have made so far
  /// mass of the periodic cell and caps on its strain rate; each missing value is taken from the options of the run
  CellResponse cell;
  /// vibration of the packing just before the relaxation to this equilibrium; absent if there is none
  std::optional<Vibration> vibration;
  int stage = -1;                   ///< number of the stage of the load path, from 0; -1 for the assembly
  std::string control = {};         ///< keyword of the stage for the kind of loading, for example "triaxial"
  int axis = 0;                     ///< axis that the stage drives, counted from 0
  std::vector<AxisStep> axes = {};  ///< load on each axis; empty if `pressure` acts on every axis
  double shear =
      0.0;  ///< shear strain along the first axis at this equilibrium, measured from the start of the stage
  double shear_step = 0.0;  ///< change of the shear strain from the previous equilibrium to this equilibrium

  bool is_isotropic() const { return axes.empty(); }
  bool shears() const { return shear_step != 0.0; }
};

/// Returns the stress on each axis at the start of the load path: the stress in the last equilibrium of the assembly.
/// @param dimension  number of axes, 2 or 3
KnownStress first_stress(const AssemblyOptions& assembly, int dimension);

/// Returns all equilibria that a run will make, in order:
/// 1. the equilibria of the assembly: one at the first pressure, preceded by one at zero pressure if the grains are
/// aggregated. If the assembly has a friction coefficient of its own, this coefficient replaces that of the contact law
/// in these equilibria.
/// 2. the equilibrium of every step of every stage of the load path. If a stage ends at equal stresses on all axes but
/// starts from different stresses, each step of the stage has a separate load for each axis.
///
/// If a saved packing keeps its stresses (SavedStart::kept), the equilibrium of the assembly keeps these stresses, and
/// its PlannedEquilibrium::control is "axes".
///
/// A vibration acts on the saved packing from which the run starts. If the run starts from a gas instead, the last
/// equilibrium of the assembly is vibrated, and one more equilibrium at the same pressure follows.
/// @param dimension  number of axes, 2 or 3
/// @throws InputError if a stage has loads for another number of axes, if a stage changes a parameter that the contact
/// law does not have, if the assembly has a friction coefficient although the contact law has no friction, or if grains
/// without adhesion would have to be in equilibrium at zero stress
std::vector<PlannedEquilibrium> plan_run(const AssemblyOptions& assembly, const Law& law,
                                         const std::vector<LoadStage>& load, int dimension);

/// Returns a pointer to the parameter of a contact law that is set by a key of a scene; null if the law has no such
/// parameter.
/// @param key  path of the key below the table [contact], e.g. "adhesion.force"
double* law_number(LawParameters& law, const std::string& key);

/// Changes one parameter of a contact law, for example "adhesion.force" to 0 or "friction.coefficient" to 0.3.
/// @param key  path of the parameter's key below the table [contact] of a scene
/// @param value  new value of the parameter
/// @throws InputError if the law has no such parameter, or if the law would be invalid with the new value
void change_law(Law& law, const std::string& key, double value);

}  // namespace floc
