#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/assembly/box_options.h"
#include "floc/assembly/diameters.h"
#include "floc/assembly/saved_start.h"
#include "floc/assembly/shape_options.h"
#include "floc/assembly/vibration.h"
#include "floc/relaxation/cell_response.h"

namespace floc {

/// Number, sizes and density of the grains of a scene, before the grains are placed.
struct GrainOptions {
  int count = 0;
  DiameterDistribution diameter;
  /// Mass of a grain divided by its area (2D) or volume (3D). The density may be absent in reduced units: a grain of
  /// diameter d then has the mass d^Dim, so that a grain of diameter 1 has mass 1.
  std::optional<double> density;
  std::optional<ShapeOptions> shape;  ///< shapes of the grains; absent for disks and spheres

  /// Smallest and largest diameter among the grains (length).
  double smallest() const { return smallest_and_largest(diameter, count).first; }
  double largest() const { return smallest_and_largest(diameter, count).second; }
};

/// Kind of the gas (grains that do not touch) from which an assembly starts.
enum class GasKind {
  equilibrated,  ///< hard grains in thermal equilibrium
  /// grains added one by one at random positions; more grains nearly touch than in equilibrium
  sequential_addition,
};

/// Options of the assembly of a packing (docs/physics.md, "Assembly and loading").
struct AssemblyOptions {
  enum class Protocol {
    /// Starts from a gas at rest and compresses it under controlled stress from the beginning (assembly of type 1; also
    /// possible for grains without cohesion).
    direct,
    /// Starts from a moving gas in a fixed cell. The grains collide and stick together until they form one cluster. The
    /// cluster is then brought to equilibrium, first at zero pressure and then at the first pressure (assembly of type
    /// 2).
    aggregation,
    /// starts from a saved packing, or from copies of it joined side by side, and brings the packing to the first
    /// pressure
    state,
  };
  Protocol protocol = Protocol::direct;
  GasKind gas = GasKind::equilibrated;
  double solid_fraction = 0.0;  ///< solid fraction of the gas or of the saved packing at the start
  /// Root mean square speed of the grains at the start, divided by V*; zero if the grains are at rest. V* = sqrt(F0
  /// D0/m), with the pull-off force F0, the range D0 of the adhesion and the mass m of the largest grain. If no
  /// adhesion acts across a gap, V* = sqrt(P a^Dim/m), with the first pressure P and the largest diameter a.
  double agitation = 0.0;
  /// first pressure of the run; the assembly ends at this pressure (stress unit of the scene)
  double pressure = 0.0;
  /// Friction coefficient during the assembly; absent if the coefficient of the contact law is used.
  std::optional<double> friction;
  CellResponse cell;  ///< mass of the cell and caps on its strain rate during the assembly
  /// vibration of the packing that was read from a file or made from a gas; absent if the packing is not vibrated
  std::optional<Vibration> vibration;
  SavedStart saved;  ///< saved packing from which the protocol `state` starts
  /// Box with walls around the grains; absent if the cell is periodic. If `solid_fraction` is zero, the sides in the
  /// options of the box are lengths; otherwise they only give the proportions of the box.
  std::optional<BoxOptions> box;
};

}  // namespace floc
