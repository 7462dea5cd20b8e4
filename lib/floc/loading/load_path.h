#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/packing/load_target.h"
#include "floc/packing/state.h"
#include "floc/relaxation/cell_response.h"

namespace floc {

/// Load on one axis at the end of a stage.
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

/// One stage of a load path, from the present load to another. By default the pressure on every axis goes to
/// `to` in geometric steps. A stage to the present pressure is a hold: it makes one new equilibrium, after the
/// changes of `set`.
struct LoadStage {
  std::string name;  ///< branch name: "load", "unload", ...
  double to = 0.0;   ///< pressure (unit of stress of the scene), >= 0; unused where the axes are given
  /// Pressure grows by 10^(1/steps_per_decade) per step; the last may be shorter.
  std::optional<double> steps_per_decade;
  std::optional<int> steps;  ///< number of equal factors, in place of steps_per_decade
  /// Changes of the contact law at the start of the stage: path below [contact] and value, e.g.
  /// "adhesion.force" and 0.
  std::vector<std::pair<std::string, double>> set;
  CellResponse cell;                ///< response of the cell during the stage
  std::string control;              ///< "oedometric", "triaxial", ...: how the axes are loaded
  int axis = 0;                     ///< driven axis, from 0
  std::vector<AxisLoad> axes = {};  ///< load of each axis at the end; empty: the pressure `to`
  /// Simple shear at the end of the stage: displacement of the planes across `axis` along the first axis, over
  /// the length of `axis` at the start of the stage.
  double shear = 0.0;

  bool is_isotropic() const { return axes.empty(); }
};

/// Pressures of the steps of a stage that starts at the pressure `from`; the last is exactly `stage.to`. A
/// stage from zero or to zero has no factor per step and is made in one step.
std::vector<double> stage_pressures(double from, const LoadStage& stage);

/// Load that one step of a stage imposes on an axis: the load at the end of the stage, and the share of the
/// change since the start of the stage that is made by the end of the step, in (0, 1].
struct AxisStep {
  AxisLoad load;
  double share = 1.0;
};

/// Stress on each axis as far as it is known before the run, compression positive; absent where a strain is
/// imposed.
using KnownStress = std::vector<std::optional<double>>;

/// Whether the stresses on all axes are known and equal.
bool is_isotropic(const KnownStress& stress);

/// Known stresses after a stage that starts from known stresses.
KnownStress after_stage(const KnownStress& from, const LoadStage& stage);

/// Number of steps of a stage whose axes are loaded differently, starting from the stresses `from`.
/// @pre `steps` is given where the number does not follow from steps_per_decade
int number_of_steps(const KnownStress& from, const LoadStage& stage);

/// Stresses and lengths that a step of a stage imposes. Over equal shares of the stage, stresses change by
/// equal factors where both ends are positive, else by equal differences, and strains change by equal amounts.
/// @param axes  load of each axis
/// @param turn  sides and stresses at the start of the stage
template <int Dim>
LoadTarget<Dim> load_target(const std::vector<AxisStep>& axes, const StageReference& turn);

}  // namespace floc
