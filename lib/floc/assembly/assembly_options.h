#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/assembly/box_options.h"
#include "floc/assembly/diameters.h"
#include "floc/assembly/saved_start.h"
#include "floc/assembly/vibration.h"
#include "floc/relaxation/cell_response.h"

namespace floc {

/// Grains of a scene before they are placed.
struct GrainOptions {
  int count = 0;
  DiameterDistribution diameter;
  /// Mass per area (2D) or volume (3D). Absent in reduced units: a grain of unit diameter has unit mass,
  /// m = d^Dim.
  std::optional<double> density;
};

/// Kind of the gas from which an assembly starts.
enum class GasKind {
  equilibrated,         ///< hard grains in equilibrium
  sequential_addition,  ///< grains added at random one by one: more of them nearly touch
};

/// Options of the assembly of a packing (docs/physics.md, "Assembly and loading").
struct AssemblyOptions {
  enum class Protocol {
    direct,       ///< gas at rest, stress control at once (type 1; also cohesionless)
    aggregation,  ///< agitated in a fixed cell to one cluster, then P = 0, then the first pressure (type 2)
    state,        ///< a saved packing, tiled, taken to the first pressure
  };
  Protocol protocol = Protocol::direct;
  GasKind gas = GasKind::equilibrated;
  double solid_fraction = 0.0;  ///< solid fraction of the gas, or of the saved packing
  /// Speed at the start over V*, V0/V* with V* = sqrt(F0 D0/m), or sqrt(P a^Dim/m) where no adhesion reaches
  /// across a gap. It is used by every protocol; zero leaves the grains at rest.
  double agitation = 0.0;
  double pressure = 0.0;  ///< first pressure (unit of stress of the scene)
  /// Friction coefficient during the assembly, where it differs from that of the material.
  std::optional<double> friction;
  CellResponse cell;                   ///< response of the cell during the assembly
  std::optional<Vibration> vibration;  ///< vibration of the saved packing, or of the one made from a gas
  SavedStart saved;                    ///< start of the protocol `state`
  /// Walls around the grains; absent: a periodic cell. If `solid_fraction` is zero, the sides of the box are
  /// lengths.
  std::optional<BoxOptions> box;
};

}  // namespace floc
