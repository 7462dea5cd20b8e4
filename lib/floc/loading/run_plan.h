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
  double pressure;     ///< pressure on every axis (unit of stress of the scene); unused where `axes` are given
  Law law;             ///< contact law, with all changes up to this equilibrium
  CellResponse cell;   ///< response of the cell, where it differs from that of the run
  std::optional<Vibration> vibration;  ///< vibration before the equilibrium
  int stage = -1;                      ///< stage of the load path, from 0; -1: the assembly
  std::string control = {};            ///< how the axes are loaded
  int axis = 0;                        ///< driven axis, from 0
  std::vector<AxisStep> axes = {};     ///< load of each axis; empty: `pressure` on every axis
  double shear = 0.0;                  ///< shear strain along the first axis since the start of the stage
  double shear_step = 0.0;             ///< shear strain of this step alone

  bool is_isotropic() const { return axes.empty(); }
  bool shears() const { return shear_step != 0.0; }
};

/// Plans all equilibria of a run, in order: first those of the assembly (aggregation: P = 0, then the first
/// pressure), then every step of every stage. The assembly uses its own friction coefficient where it has one.
/// A vibration acts on the saved packing or, after a gas, on the first equilibrium; another equilibrium follows
/// at the same pressure. A stage may end at the same pressure on every axis even if it starts from different
/// stresses.
/// @param dimension  number of axes, 2 or 3
/// @throws InputError if a stage loads another number of axes or changes a parameter that the law does not
/// have, or if the assembly sets the friction of a law without friction
std::vector<PlannedEquilibrium> plan_run(const AssemblyOptions& assembly, const Law& law,
                                         const std::vector<LoadStage>& load, int dimension);

/// Number of a contact law with this key; null if its slot is empty or there is no such key.
/// @param key  path below [contact], e.g. "adhesion.force"
double* law_number(LawParameters& law, const std::string& key);

/// Makes one change of a contact law: "adhesion.force" = 0, "friction.coefficient" = 0.3, ...
/// @param key  path below [contact]
/// @throws InputError if the key is unknown, its slot absent, or the law would be invalid
void change_law(Law& law, const std::string& key, double value);

}  // namespace floc
