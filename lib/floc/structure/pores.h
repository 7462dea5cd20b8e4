#pragma once

#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// One pore of a 2D packing.
struct Pore {
  double area = 0.0;               ///< (area)
  double gyration_radius = 0.0;    ///< root mean square distance of its points from its centre of mass (length)
  Vec<2> centre = Vec<2>::Zero();  ///< centre of mass, inside the cell
  std::vector<int> grains;  ///< grains around it, counter-clockwise; a grain touched twice is listed twice
};

/// Pores of a 2D packing: the faces of the network of its interactions (distant attractions close pores too),
/// less the sectors of the disks around them and the disks inside (docs/physics.md, "Structure"). Closed forms,
/// no mesh: areas add up to A (1 - Phi) with overlaps counted twice, as in Phi.
struct Pores {
  std::vector<Pore> pores;  ///< the bounded pores
  bool unbounded = false;   ///< whether a pore winds around the cell, and so has no size
  double total_area = 0.0;  ///< area of all bounded pores
  /// xi': root of the mean of the squared radius of gyration, weighted by area (length); 0 without pores.
  double size = 0.0;
  double mean_area = 0.0;  ///< (area)
  /// Reason why there are no pores: contacts cross each other, as those of disks with large overlaps do; else
  /// empty.
  std::string failure_reason;
};

/// Finds the pores of a packing. Parts of the network and lone grains inside a pore are joined to their nearest
/// neighbour by edges of no width, which do not change the pore.
Pores find_pores(const Packing<2>& packing);

}  // namespace floc
