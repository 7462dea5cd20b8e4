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

/// The grains of a scene before they are placed.
struct GrainOptions {
  int count = 0;
  DiameterDistribution diameter;
  /// Mass per area (2D) or volume (3D). Absent in reduced units: a grain of unit diameter has unit mass,
  /// m = d^Dim.
  std::optional<double> density;
};

/// The gas that grains start as.
enum class GasKind {
  equilibrated,         ///< of hard grains in equilibrium
  sequential_addition,  ///< grains as they were added at random, one by one: more of them nearly touch
};

/// How grains are put together (docs/physics.md, "Assembly and loading").
struct AssemblyOptions {
  enum class Protocol {
    direct,       ///< gas at rest, stress control at once (type 1; also cohesionless)
    aggregation,  ///< agitated in a fixed cell to one cluster, then P = 0, then the first pressure (type 2)
    state,        ///< a saved packing, tiled, taken to the first pressure
  };
  Protocol protocol = Protocol::direct;
  GasKind gas = GasKind::equilibrated;
  double solid_fraction = 0.0;  ///< of the gas, or of the saved packing
  /// V0/V*, V* = sqrt(F0 D0/m), or sqrt(P a^Dim/m) where no adhesion reaches across a gap: for the aggregation
  /// protocol, and for others, where zero leaves grains at rest.
  double agitation = 0.0;
  double pressure = 0.0;  ///< first pressure (unit of stress of the scene)
  /// Friction coefficient while grains are put together, where it is not that of the material.
  std::optional<double> friction;
  CellResponse cell;                   ///< while grains are put together
  std::optional<Vibration> vibration;  ///< of a saved packing, or of one put together from a gas
  SavedStart saved;                    ///< of the protocol that starts from one
  /// Walls around the grains; none: a periodic cell. `solid_fraction` zero: the sides of the box are lengths.
  std::optional<BoxOptions> box;
};

}  // namespace floc
