#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/assembly/assembly_options.h"
#include "floc/contact/law.h"
#include "floc/loading/load_path.h"

namespace floc {

/// One equilibrium that a run will make.
struct PlannedEquilibrium {
  std::string branch;  ///< "assembly" or the name of the stage
  double pressure;     ///< pressure on every axis (unit of stress of the scene); unused if `axes` are given
  Law law;             ///< contact law, after the changes made by all stages up to this equilibrium
  CellResponse cell;   ///< caps on the strain rate and mass of the cell, if they differ from those of the run
  std::optional<Vibration> vibration;  ///< vibration before the equilibrium
  int stage = -1;                      ///< number of the stage of the load path, from 0; -1 for the assembly
  std::string control = {};            ///< keyword for how the axes are loaded, for example "triaxial"
  int axis = 0;                        ///< axis that is driven, counted from 0
  std::vector<AxisStep> axes = {};     ///< load of each axis; empty if `pressure` acts on every axis
  double shear = 0.0;                  ///< shear strain along the first axis since the start of the stage
  double shear_step = 0.0;             ///< shear strain of this step alone

  bool is_isotropic() const { return axes.empty(); }
  bool shears() const { return shear_step != 0.0; }
};

/// Returns all equilibria that a run will make, in order: first those of the assembly (for an aggregation, one at P = 0
/// and one at the first pressure), then every step of every stage. If a friction coefficient is given for the assembly,
/// the assembly uses it. A vibration acts on the saved packing or, if the packing is made from a gas, on its first
/// equilibrium; another equilibrium at the same pressure is then added after the vibration. A stage may end at the same
/// pressure on every axis even if it starts from different stresses.
/// @param dimension  number of axes, 2 or 3
/// @throws InputError if a stage loads another number of axes or changes a parameter that the law does not have, or if
/// the assembly sets the friction coefficient of a law without friction
std::vector<PlannedEquilibrium> plan_run(const AssemblyOptions& assembly, const Law& law,
                                         const std::vector<LoadStage>& load, int dimension);

/// Returns a pointer to the parameter of a contact law with this key, or null if the law has no such parameter.
/// @param key  path of the parameter below [contact], e.g. "adhesion.force"
double* law_number(LawParameters& law, const std::string& key);

/// Changes one parameter of a contact law, for example "adhesion.force" to 0 or "friction.coefficient" to 0.3.
/// @param key  path of the parameter below [contact]
/// @throws InputError if the law has no such parameter, or if the changed law would be invalid
void change_law(Law& law, const std::string& key, double value);

}  // namespace floc
