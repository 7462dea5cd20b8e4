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
    kept_stress,  ///< the stress on the axis stays as it is at the start of the stage
    strain,       ///< `end` is a logarithmic strain since the start of the stage, shortening positive
  };
  Kind kind = kept_stress;
  double end = 0.0;

  bool operator==(const AxisLoad&) const = default;
};

/// One stage of a load path. A stage changes the present load to another load in steps, with an equilibrium after each
/// step. By default the pressure on every axis changes to `to`, by an equal factor in each step. If the pressure
/// already equals `to`, the stage consists of one new equilibrium, for example after `set` has changed the contact law.
struct LoadStage {
  std::string name;  ///< name of the stage ("load", "unload", ...), stored in the states of the stage
  /// pressure on every axis at the end of the stage (stress unit of the scene), >= 0; unused if `axes` is not empty
  double to = 0.0;
  /// Number of steps per decade of pressure: each step multiplies or divides the pressure by 10^(1/steps_per_decade).
  /// The last step may be smaller.
  std::optional<double> steps_per_decade;
  std::optional<int> steps;  ///< number of steps of the stage, in place of steps_per_decade
  /// Parameters of the contact law that change at the start of the stage. Each entry consists of the path of the key
  /// below the table [contact], e.g. "adhesion.force", and the new value, e.g. 0.
  std::vector<std::pair<std::string, double>> set;
  CellResponse cell;    ///< mass of the periodic cell and caps on its strain rate during the stage
  std::string control;  ///< keyword for the kind of loading: "oedometric", "triaxial", ...
  int axis = 0;         ///< axis that the stage drives, counted from 0
  /// load on each axis at the end of the stage; empty if the pressure `to` acts on all axes
  std::vector<AxisLoad> axes = {};
  /// Shear strain at the end of a stage of simple shear; 0 in other stages. The planes perpendicular to `axis` move
  /// along the first axis. The shear strain is the displacement of a plane since the start of the stage, divided by the
  /// distance of the plane from the plane at rest.
  double shear = 0.0;

  bool is_isotropic() const { return axes.empty(); }
  /// Returns the largest magnitude of all strains that the stage imposes: the logarithmic strains of axes, and the
  /// shear strain.
  double largest_strain() const;
};

/// Returns the pressure at each step of a stage that imposes equal pressures on all axes and starts at the pressure
/// `from`. The last pressure is exactly `stage.to`. A stage from or to zero pressure has only one step, because a
/// pressure cannot become zero, or increase from zero, by equal factors.
std::vector<double> stage_pressures(double from, const LoadStage& stage);

/// Load that one step of a stage imposes on an axis.
struct AxisStep {
  AxisLoad load;  ///< load on the axis at the end of the stage
  /// fraction of the change over the whole stage that is complete at the end of this step, (0, 1]
  double share = 1.0;
};

/// Stress on each axis at a point of the load path, compression positive. If a strain is imposed on an axis, the stress
/// on this axis depends on the packing and is unknown before the run. The axis then has no value.
using KnownStress = std::vector<std::optional<double>>;

/// Whether the stresses on all axes are known and equal.
bool is_isotropic(const KnownStress& stress);

/// Returns the stress on each axis at the end of a stage; no value for an axis whose stress is unknown before the run.
/// @param from  stress on each axis at the start of the stage
KnownStress after_stage(const KnownStress& from, const LoadStage& stage);

/// Returns the number of steps of a stage whose axes have different loads or different initial stresses.
/// @param from  stress on each axis at the start of the stage; no value for an axis whose stress is unknown before the
/// run
/// @pre stage.steps is set, or stage.steps_per_decade and the stresses determine the number of steps
int number_of_steps(const KnownStress& from, const LoadStage& stage);

/// Returns the stresses and lengths that a step of a stage imposes on the axes. From one step to the next, a stress
/// changes by an equal factor if it is positive at the start and at the end of the stage, otherwise by an equal
/// difference. A logarithmic strain changes by an equal difference.
/// @param axes  for each axis, its load at the end of the stage and the fraction of the stage that is complete after
/// this step
/// @param turn  sides of the cell and stress on each axis at the start of the stage
template <int Dim>
LoadTarget<Dim> load_target(const std::vector<AxisStep>& axes, const StageReference& turn);

}  // namespace floc
