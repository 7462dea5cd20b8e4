#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/packing/bond_strength.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/load_target.h"
#include "floc/packing/motion_record.h"
#include "floc/packing/packing.h"
#include "floc/packing/step_counts.h"

namespace floc {

/// Data about the start of a stage whose load is not the same on all axes (such as an oedometric test): the sides and
/// stresses of the packing at this time. The steps of the stage refer to these data.
struct StageReference {
  /// Kind of the stage, "oedometric", "triaxial", ...; empty if the state belongs to no such stage.
  std::string control;
  int axis = 0;               ///< axis along which the packing is driven, counted from 0
  std::vector<double> sides;  ///< sides of the cell at the start of the stage (length)
  /// Stress on each axis at the start of the stage: the imposed stress or, if no stress was imposed, the stress of the
  /// packing (force/length^(Dim-1)).
  std::vector<double> stress;
  double shear = 0.0;  ///< shear strain from the start of the stage to the end of the present step

  bool empty() const { return control.empty(); }
  /// Returns whether the planes perpendicular to `axis` slide along the first axis in this stage, also if it holds
  /// them.
  bool is_simple_shear() const { return control == "simple_shear"; }
  bool operator==(const StageReference&) const = default;
};

/// Position of a state on its load path.
struct PathPosition {
  int step = 0;              ///< number of the equilibrium on the load path, 0 for the first
  std::string branch;        ///< branch of the load path: "assembly", "load", "unload", ...
  double time = 0.0;         ///< simulated time since the start of the run (time unit of the scene file)
  std::int64_t n_steps = 0;  ///< number of time steps since the start of the run
  std::string ending;  ///< how the relaxation ended: "static", "polished", "dynamic", ...; empty if not known
  StageReference turn;
  /// counts of the time steps of contact dynamics that led to the state; all zero for elastic contacts
  StepCounts counts = {};
};

/// Origin of a state: program, seed, and the state file from which the run continued. Date and time are not stored, so
/// that repetitions of a run give identical files.
struct Provenance {
  /// program that made the state: "floc 0.1.0", or the program from which a packing was converted
  std::string program;
  std::string commit;
  std::string compiler;
  std::uint64_t seed = 0;
  std::uint64_t stream_state = 0;  ///< state of the random stream with which the run continues
  /// hash of the state file from which the run continued; empty for the first state
  std::string parent_sha256;
  std::string source;  ///< file from which a packing was converted
};

/// Saved state of a run: all data that are needed to continue the run from this state, or to analyse the state.
template <int Dim>
struct State {
  std::string units = "reduced";  ///< system of units, "reduced" or "SI"
  Packing<Dim> packing;
  std::vector<BondStrength<Dim>> bond_strengths = {};  ///< sorted by precedes(); empty: no strengths are given
  /// Stress imposed on each axis, compression positive (force/length^(Dim-1)). On an axis with an imposed side length:
  /// the stress of the packing when it was saved.
  Vec<Dim> target_stress = Vec<Dim>::Zero();
  /// Side length of the cell imposed on each axis (length); zero on axes with an imposed stress.
  Vec<Dim> target_side = Vec<Dim>::Zero();
  /// Simple shear of the cell, if the load step imposed one.
  std::optional<ImposedOffset> target_offset = {};
  EquilibriumTolerance tolerance;
  Mat<Dim> stress = Mat<Dim>::Zero();  ///< static_stress() of the packing when it was saved
  Residuals residuals;                 ///< residuals reached when the state was saved
  int n_negative = -1;  ///< number of negative eigenvalues of the stiffness matrix; -1: not determined
  /// Number of liquid bridges that would form or break if the liquid were distributed once more; -1 if not determined,
  /// or without liquid. The liquid is distributed a limited number of times. If pairs were still gaining or losing
  /// bridges at the end, the number is above 0, and the bridges have the volumes of the last distribution.
  int n_bridges_unsettled = -1;
  /// Forces on the walls, in the order of the walls, as recorded in the file from which the state was read. These
  /// values are not written when the state is saved: the new file contains the forces on the walls that follow from the
  /// contacts.
  std::vector<double> wall_force = {};
  /// Time step that begins at the state, if the state is in motion (path.ending is "moving"); absent at rest.
  std::optional<MotionRecord> motion = {};
  PathPosition path;
  std::string scene;  ///< text of the scene file of the run; empty for converted packings
  Provenance provenance;
};

/// Returns the component of `stress` on the axis that is driven in the stage to which a state belongs. If this stage
/// drives no axis, the mean over the axes is returned.
template <int Dim>
double stress_on_driven_axis(const State<Dim>& state, const Vec<Dim>& stress) {
  return state.path.turn.empty() ? stress.mean() : stress[state.path.turn.axis];
}

/// Sets the stress and the residuals of a state. They are computed from the contact forces of the packing and from the
/// target stress.
template <int Dim>
void measure(State<Dim>& state);

}  // namespace floc
