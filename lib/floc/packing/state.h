#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/packing/equilibrium.h"
#include "floc/packing/load_target.h"
#include "floc/packing/packing.h"

namespace floc {

/// Stage of a load path in which axes are loaded differently, with the state at its start, which is the
/// reference of its steps.
struct StageReference {
  std::string control;         ///< "oedometric", "triaxial", ...; empty outside such stages
  int axis = 0;                ///< driven axis, from 0
  std::vector<double> sides;   ///< sides of the cell at the start (length)
  std::vector<double> stress;  ///< stress on each axis at the start, imposed or carried
  double shear = 0.0;          ///< shear strain from the start of the stage to the end of this step

  bool empty() const { return control.empty(); }
  bool operator==(const StageReference&) const = default;
};

/// Place of a state on its load path.
struct PathPosition {
  int step = 0;              ///< number of the equilibrium, 0 for the first saved
  std::string branch;        ///< "assembly", "load", "unload", ...
  double time = 0.0;         ///< simulated time since the start (time unit of the scene)
  std::int64_t n_steps = 0;  ///< time steps since the start
  std::string ending;  ///< end of the relaxation: "static", "polished", "dynamic", ...; empty if not known
  StageReference turn;
};

/// Origin of a state: program, seed and parent. It holds no clock time, so that repeated runs give identical
/// files.
struct Provenance {
  std::string program;  ///< "floc 0.1.0", or the program a converted packing came from
  std::string commit;
  std::string compiler;
  std::uint64_t seed = 0;
  std::uint64_t stream_state = 0;  ///< state of the random stream, from which the run continues
  std::string parent_sha256;  ///< hash of the state file that the run continued from; empty for the first state
  std::string source;         ///< converted packings: the file they came from
};

/// Saved state: all data that determine how a run continues from it, and all data that an analysis needs.
template <int Dim>
struct State {
  std::string units = "reduced";  ///< "reduced" or "SI"
  Packing<Dim> packing;
  /// Stress imposed on each axis, compression positive; on an axis with an imposed length, the stress that it
  /// carried.
  Vec<Dim> target_stress = Vec<Dim>::Zero();
  Vec<Dim> target_side = Vec<Dim>::Zero();          ///< length imposed on an axis; zero where a stress is
  std::optional<ImposedOffset> target_offset = {};  ///< offset imposed by a step of simple shear
  EquilibriumTolerance tolerance;
  Mat<Dim> stress = Mat<Dim>::Zero();  ///< static_stress() of the packing, when saved
  Residuals residuals;                 ///< reached when saved
  int n_negative = -1;  ///< number of negative eigenvalues of the stiffness matrix; -1: not determined
  /// For a law with liquid, number of bridges that would form or break if the liquid were shared out once more.
  /// It is above 0 if the bridges kept their volumes after many trials; -1: not determined.
  int n_bridges_unsettled = -1;
  /// Forces on the walls as recorded in the file that the state was read from, in the order of the walls. A
  /// saved file records the forces of the contacts instead.
  std::vector<double> wall_force = {};
  PathPosition path;
  std::string scene;  ///< text of the scene, empty for converted packings
  Provenance provenance;
};

/// Sets the stress and the residuals of a state to those of its packing under its target stress.
template <int Dim>
void measure(State<Dim>& state);

}  // namespace floc
