#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/packing/load_target.h"
#include "floc/packing/state.h"
#include "floc/relaxation/cell_response.h"

namespace floc {

/// Load that a stage of the load path imposes on one axis at its end.
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

/// One stage of a load path: it leads the packing in steps from the present load to another load, with an equilibrium
/// after each step. By default the pressure on every axis changes to `to`, by an equal factor in each step. If the
/// pressure is already `to`, the stage makes one new equilibrium, for example after `set` has changed the contact law.
struct LoadStage {
  std::string name;  ///< name of the stage ("load", "unload", ...), recorded in the states that it makes
  /// pressure on every axis at the end of the stage (stress unit of the scene), >= 0; unused if `axes` is not empty
  double to = 0.0;
  /// Number of steps per decade of pressure: each step multiplies or divides the pressure by 10^(1/steps_per_decade).
  /// The last step may be smaller.
  std::optional<double> steps_per_decade;
  std::optional<int> steps;  ///< number of steps of the stage, in place of steps_per_decade
  /// Parameters of the contact law that change at the start of the stage. Each has the path of its key below the table
  /// [contact], e.g. "adhesion.force", and its new value, e.g. 0.
  std::vector<std::pair<std::string, double>> set;
  CellResponse cell;    ///< mass of the periodic cell and caps on its strain rate during the stage
  std::string control;  ///< keyword for how the axes are loaded: "oedometric", "triaxial", ...
  int axis = 0;         ///< axis along which the stage drives the packing, counted from 0
  /// load on each axis at the end of the stage; empty if the pressure `to` acts on all axes
  std::vector<AxisLoad> axes = {};
  /// Shear strain at the end of a stage of simple shear; 0 in other stages. The planes perpendicular to `axis` move
  /// along the first axis. The shear strain is the displacement of such a plane divided by its distance from the plane
  /// that stays in place; both are measured from the start of the stage.
  double shear = 0.0;

  bool is_isotropic() const { return axes.empty(); }
  /// Returns the largest magnitude of the strains that the stage imposes: a logarithmic strain of a length, or a shear
  /// strain.
  double largest_strain() const;
};

/// Returns the pressure at each step of a stage that imposes equal pressures on all axes and starts at the pressure
/// `from`. The last pressure is exactly `stage.to`. If `from` or `stage.to` is zero, the stage has only one step,
/// because no finite factor leads from or to zero.
std::vector<double> stage_pressures(double from, const LoadStage& stage);

/// Load that one step of a stage imposes on an axis.
struct AxisStep {
  AxisLoad load;  ///< load on the axis at the end of the stage
  /// fraction of the change over the whole stage that is complete at the end of this step, (0, 1]
  double share = 1.0;
};

/// Stress on each axis at a point of the load path, compression positive. It is absent for an axis on which a strain is
/// imposed: the stress then depends on the packing, so it is unknown before the run.
using KnownStress = std::vector<std::optional<double>>;

/// Whether the stresses on all axes are known and equal.
bool is_isotropic(const KnownStress& stress);

/// Returns the stress on each axis at the end of a stage, as far as it is known before the run.
/// @param from  stress on each axis at the start of the stage
KnownStress after_stage(const KnownStress& from, const LoadStage& stage);

/// Returns the number of steps of a stage that imposes different loads on its axes, or that starts from different
/// stresses on its axes.
/// @param from  stress on each axis at the start of the stage, as far as it is known before the run
/// @pre stage.steps is given, unless steps_per_decade and the stresses determine the number of steps
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
