#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/packing/equilibrium.h"
#include "floc/packing/load_target.h"
#include "floc/packing/packing.h"

namespace floc {

/// The turn of a load path in which axes are loaded differently, and where it started: the reference for the
/// next step of the turn.
struct StageReference {
  std::string control;         ///< "oedometric", "triaxial", ...; empty outside such turns
  int axis = 0;                ///< the driven one, from 0
  std::vector<double> sides;   ///< of the cell at the start (length)
  std::vector<double> stress;  ///< on each axis at the start, imposed or carried
  double shear = 0.0;          ///< of simple shear: strain since the start, by the end of this step

  bool empty() const { return control.empty(); }
  bool operator==(const StageReference&) const = default;
};

/// The place of a state on its load path.
struct PathPosition {
  int step = 0;              ///< number of the equilibrium, 0 for the first saved
  std::string branch;        ///< "assembly", "load", "unload", ...
  double time = 0.0;         ///< simulated time since the start (time unit of the scene)
  std::int64_t n_steps = 0;  ///< time steps since the start
  std::string ending;  ///< how the relaxation ended: "static", "polished", "dynamic"; empty where not known
  StageReference turn;
};

/// What made a state, and from what. No clock time: repeated runs give identical files.
struct Provenance {
  std::string program;  ///< "floc 0.1.0", or the program a converted packing came from
  std::string commit;
  std::string compiler;
  std::uint64_t seed = 0;
  std::uint64_t stream_state = 0;  ///< of the random stream that continues from here
  std::string parent_sha256;       ///< of the state file this one was loaded from; empty for the first
  std::string source;              ///< converted packings: the file they came from
};

/// A saved state: all that decides its future and all that an analysis needs.
template <int Dim>
struct State {
  std::string units = "reduced";  ///< "reduced" or "SI"
  Packing<Dim> packing;
  /// Diagonal stress imposed, compression positive; on an axis with a length imposed, the stress it carried.
  Vec<Dim> target_stress = Vec<Dim>::Zero();
  Vec<Dim> target_side = Vec<Dim>::Zero();          ///< length imposed on an axis; zero where a stress is
  std::optional<ImposedOffset> target_offset = {};  ///< of the step of a simple shear
  EquilibriumTolerance tolerance;
  Mat<Dim> stress = Mat<Dim>::Zero();  ///< static_stress() of the packing, when saved
  Residuals residuals;                 ///< reached when saved
  int n_negative = -1;                 ///< negative eigenvalues of the stiffness matrix; -1: not determined
  /// For a law with liquid: bridges that would form or break if the liquid were shared out once more, above 0
  /// where the liquid was held in place after many trials; -1: not determined.
  int n_bridges_unsettled = -1;
  /// Of states read from a file: the forces on the walls that it records, in their order. What is saved are those of
  /// the contacts.
  std::vector<double> wall_force = {};
  PathPosition path;
  std::string scene;  ///< text of the scene, empty for converted packings
  Provenance provenance;
};

/// Sets the stress and the residuals of a state to those of its packing under its target stress.
template <int Dim>
void measure(State<Dim>& state);

}  // namespace floc
