#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/packing/load_target.h"
#include "floc/packing/state.h"
#include "floc/relaxation/cell_response.h"

namespace floc {

/// What a stage imposes on one axis by its end.
struct AxisLoad {
  enum Kind {
    stress,       ///< `end` is a stress, compression positive
    kept_stress,  ///< the stress it has at the start of the stage
    strain,       ///< `end` is a logarithmic strain from the start of the stage, shortening positive
  };
  Kind kind = kept_stress;
  double end = 0.0;

  bool operator==(const AxisLoad&) const = default;
};

/// One stage of a load path: from the present load to another. By default the same pressure on every axis, in
/// geometric steps to `to`; a stage to the present pressure is a hold: one new equilibrium, after the changes
/// of `set`.
struct LoadStage {
  std::string name;  ///< branch name: "load", "unload", ...
  double to = 0.0;   ///< pressure (unit of stress of the scene), >= 0; unused where the axes are given
  /// Pressure grows by 10^(1/steps_per_decade) per step; the last may be shorter.
  std::optional<double> steps_per_decade;
  std::optional<int> steps;  ///< or this many equal factors
  /// Changes of the contact law made when the stage starts: path below [contact] and value, e.g.
  /// "adhesion.force" 0.
  std::vector<std::pair<std::string, double>> set;
  CellResponse cell;                ///< during the stage
  std::string control;              ///< "oedometric", "triaxial", ...: how the axes are loaded
  int axis = 0;                     ///< the driven one, from 0
  std::vector<AxisLoad> axes = {};  ///< what each axis is brought to; empty: the pressure `to`
  /// Simple shear at the end: how far the planes across `axis` have moved along the first axis, over the length
  /// of `axis` at the start of the stage.
  double shear = 0.0;

  bool is_isotropic() const { return axes.empty(); }
};

/// Pressures of a stage that starts at `from`, the last exactly `stage.to`. From zero or to zero there is no
/// such factor, and one step is made.
std::vector<double> stage_pressures(double from, const LoadStage& stage);

/// What one step of a stage imposes on an axis: its load at the end of the stage, and how much of the way to it
/// is done.
struct AxisStep {
  AxisLoad load;
  double share = 1.0;
};

/// What is known about the stress on each axis before a run: where a strain is imposed, nothing.
using KnownStress = std::vector<std::optional<double>>;

/// Whether the same known stress is on every axis.
bool is_isotropic(const KnownStress& stress);

/// The known stresses after a stage.
KnownStress after_stage(const KnownStress& from, const LoadStage& stage);

/// Number of steps of a stage whose axes are loaded differently, starting from these stresses.
/// @pre steps are given where the number cannot follow from steps_per_decade
int number_of_steps(const KnownStress& from, const LoadStage& stage);

/// What is imposed at the present point of a turn: stresses go by equal factors where both ends are positive,
/// else by equal differences; strains by equal amounts.
template <int Dim>
LoadTarget<Dim> load_target(const std::vector<AxisStep>& axes, const StageReference& turn);

}  // namespace floc
