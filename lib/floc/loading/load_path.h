#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/packing/load_target.h"
#include "floc/packing/state.h"
#include "floc/relaxation/cell_response.h"

namespace floc {

/// Load on one axis at the end of a stage of the load path.
struct AxisLoad {
  enum Kind {
    stress,       ///< `end` is a stress, compression positive
    kept_stress,  ///< the stress of the axis at the start of the stage is kept
    strain,       ///< `end` is a logarithmic strain from the start of the stage, shortening positive
  };
  Kind kind = kept_stress;
  double end = 0.0;

  bool operator==(const AxisLoad&) const = default;
};

/// One stage of a load path, which leads from the present load to another. By default the pressure on every axis
/// changes to `to` in steps by equal factors. A stage to the present pressure makes one new equilibrium after the
/// changes of `set`.
struct LoadStage {
  std::string name;  ///< name of the stage, recorded in its states: "load", "unload", ...
  /// pressure at the end of the stage (unit of stress of the scene), >= 0; unused if `axes` are given
  double to = 0.0;
  /// Number of steps per decade of pressure: the pressure changes by the factor 10^(1/steps_per_decade) per step. The
  /// last step may be smaller.
  std::optional<double> steps_per_decade;
  std::optional<int> steps;  ///< number of steps by equal factors, in place of steps_per_decade
  /// Changes of the contact law at the start of the stage: path of a parameter below [contact], and its new value, e.g.
  /// "adhesion.force" and 0.
  std::vector<std::pair<std::string, double>> set;
  CellResponse cell;                ///< caps on the strain rate and mass of the cell during the stage
  std::string control;              ///< keyword for how the axes are loaded: "oedometric", "triaxial", ...
  int axis = 0;                     ///< axis that is driven, counted from 0
  std::vector<AxisLoad> axes = {};  ///< load of each axis at the end; empty if the pressure `to` acts on all
  /// Shear strain of a simple shear at the end of the stage: displacement along the first axis of the planes
  /// perpendicular to `axis`, over the length of `axis` at the start of the stage.
  double shear = 0.0;

  bool is_isotropic() const { return axes.empty(); }
};

/// Returns the pressures of the steps of a stage that starts at the pressure `from`. The last pressure is exactly
/// `stage.to`. If `from` or `stage.to` is zero, no factor per step exists and the stage has one step.
std::vector<double> stage_pressures(double from, const LoadStage& stage);

/// Load that one step of a stage imposes on an axis: the load at the end of the stage, and the share of the change from
/// the start to the end of the stage that is made by the end of this step, in (0, 1].
struct AxisStep {
  AxisLoad load;
  double share = 1.0;
};

/// Stress on each axis, compression positive, as far as it is known before the run. It is absent for an axis on which a
/// strain is imposed.
using KnownStress = std::vector<std::optional<double>>;

/// Whether the stresses on all axes are known and equal.
bool is_isotropic(const KnownStress& stress);

/// Returns the stresses that are known after a stage.
/// @param from  stresses that are known before the stage
KnownStress after_stage(const KnownStress& from, const LoadStage& stage);

/// Returns the number of steps of a stage whose axes are loaded differently.
/// @param from  stresses that are known before the stage
/// @pre `stage.steps` is given if the number does not follow from steps_per_decade
int number_of_steps(const KnownStress& from, const LoadStage& stage);

/// Returns the stresses and lengths that a step of a stage imposes. Over equal shares of the stage, a stress changes by
/// equal factors if it is positive at the start and at the end, otherwise by equal differences. Strains change by equal
/// differences.
/// @param axes  load of each axis
/// @param turn  sides and stresses at the start of the stage
template <int Dim>
LoadTarget<Dim> load_target(const std::vector<AxisStep>& axes, const StageReference& turn);

}  // namespace floc
