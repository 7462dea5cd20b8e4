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
  /// Mass per area (2D) or volume (3D) of the grains. Absent in reduced units: a grain of unit diameter then
  /// has unit mass, and a grain of diameter d has the mass d^Dim.
  std::optional<double> density;
};

/// Kind of the gas of grains from which an assembly starts.
enum class GasKind {
  equilibrated,         ///< hard grains in thermal equilibrium
  sequential_addition,  ///< grains added one by one at random positions; more pairs of them nearly touch
};

/// Options of the assembly of a packing (docs/physics.md, "Assembly and loading").
struct AssemblyOptions {
  enum class Protocol {
    /// Starts from a gas at rest, under controlled stress from the beginning (type 1; also without cohesion).
    direct,
    /// Lets a moving gas stick together in a fixed cell until it is one cluster, then relaxes it at P = 0 and
    /// at the first pressure (type 2).
    aggregation,
    state,  ///< starts from a saved packing, tiled, and loads it to the first pressure
  };
  Protocol protocol = Protocol::direct;
  GasKind gas = GasKind::equilibrated;
  double solid_fraction = 0.0;  ///< solid fraction of the gas or of the saved packing
  /// Root mean square speed of the grains at the start, in units of V* = sqrt(F0 D0/m) with the pull-off force
  /// F0, the range D0 of the adhesion and the mass m of the largest grain. If no adhesion acts across a gap, V*
  /// = sqrt(P a^Dim/m) with the first pressure P and the largest diameter a. Every protocol uses it; zero
  /// leaves the grains at rest.
  double agitation = 0.0;
  double pressure = 0.0;  ///< first pressure of the load path (stress unit of the scene)
  /// Friction coefficient during the assembly, if it differs from the friction coefficient of the contact law.
  std::optional<double> friction;
  CellResponse cell;                   ///< response of the cell during the assembly
  std::optional<Vibration> vibration;  ///< vibration of the saved packing, or of the packing made from a gas
  SavedStart saved;                    ///< saved packing from which the protocol `state` starts
  /// Box with walls around the grains; absent: a periodic cell. If `solid_fraction` is zero, the sides of the
  /// box are given as lengths.
  std::optional<BoxOptions> box;
};

}  // namespace floc
