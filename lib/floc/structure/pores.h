#pragma once

#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// One pore of a 2D packing.
struct Pore {
  double area = 0.0;  ///< area of the pore (length^2)
  /// Root mean square distance of the points of the pore from its centre of mass (length).
  double gyration_radius = 0.0;
  Vec<2> centre = Vec<2>::Zero();  ///< centre of mass of the pore, inside the cell (length)
  /// Indices of the grains around the pore, counter-clockwise; a grain that the pore touches twice is listed twice.
  std::vector<int> grains;
};

/// Pores of a 2D packing (docs/physics.md, "Structure"). Interactions, including attractions across gaps, are the edges
/// of a network. A pore is a face of this network without the area covered by disks. The areas of the pores are
/// computed in closed form. Their sum is A (1 - Phi), where A is the area of the cell, and Phi the solid fraction, in
/// which overlaps count twice.
struct Pores {
  std::vector<Pore> pores;  ///< pores that do not wind around the periodic cell
  /// Whether there is also a pore that winds around the cell. Such a pore has no size.
  bool unbounded = false;
  double total_area = 0.0;  ///< sum of the areas of `pores` (length^2)
  /// Size xi' of the pores (length): root of the mean squared radius of gyration, weighted by area; 0 without pores.
  double size = 0.0;
  double mean_area = 0.0;  ///< mean area of the pores (length^2)
  /// Reason why the pores could not be identified, or an empty text. If overlaps are large, lines between the centres
  /// of touching grains may cross each other.
  std::string failure_reason;
};

/// Finds the pores of a packing. The network of interactions may have separate parts, or single grains inside a pore.
/// Extra edges join these parts and grains to the network across the smallest gaps, which does not change the area of
/// the pore.
Pores find_pores(const Packing<2>& packing);

}  // namespace floc
