#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/assembly/assembly_options.h"
#include "floc/contact/law.h"
#include "floc/loading/load_path.h"

namespace floc {

/// One equilibrium a run will make.
struct PlannedEquilibrium {
  std::string branch;  ///< "assembly" or the name of the stage
  double pressure;     ///< on every axis (unit of stress of the scene); unused where `axes` are given
  Law law;             ///< with the changes made so far
  CellResponse cell;   ///< where it differs from that of the run
  std::optional<Vibration> vibration;  ///< before it
  int stage = -1;                      ///< of the load path, from 0; -1: of the assembly
  std::string control = {};            ///< how the axes are loaded
  int axis = 0;                        ///< the driven one, from 0
  std::vector<AxisStep> axes = {};     ///< empty: the pressure
  double shear = 0.0;       ///< of simple shear along the first axis: strain since the start of the stage
  double shear_step = 0.0;  ///< that of this step alone

  bool is_isotropic() const { return axes.empty(); }
  bool shears() const { return shear_step != 0.0; }
};

/// All equilibria of a run, in order: those of the assembly (aggregation: P = 0, then the first pressure), then
/// every step of every stage. Grains are put together under the friction of the assembly, where it has one.
/// What is shaken is a saved packing or, after a gas, the first equilibrium; another equilibrium follows at the
/// same pressure. Stages that end at the same pressure on every axis go there from whatever stresses the axes
/// have.
/// @param dimension  number of axes, 2 or 3
/// @throws InputError if a stage loads another number of axes or changes something that the law does not have, or
/// if the assembly is to give friction to a law without any
std::vector<PlannedEquilibrium> plan_run(const AssemblyOptions& assembly, const Law& law,
                                         const std::vector<LoadStage>& load, int dimension);

/// The number of a contact law that a key names, or null when its slot is absent or there is no such key.
/// @param key  path below [contact], e.g. "adhesion.force"
double* law_number(LawParameters& law, const std::string& key);

/// Makes one change of a contact law: "adhesion.force" = 0, "friction.coefficient" = 0.3, ...
/// @param key  path below [contact]
/// @throws InputError if the key is unknown, its slot absent, or the law would be invalid
void change_law(Law& law, const std::string& key, double value);

}  // namespace floc
