#pragma once

#include "floc/tradeoff/tradeoff.h"

namespace floc {

/// Options of a study of the lattice of cemented grains.
struct LatticeStudyOptions {
  double matrix_content = 0.1;     ///< share of the volume that the matrix fills
  double stiffness_ratio = 100.0;  ///< stiffness of elements in grains over that of elements in the matrix
  static constexpr NumberRange kRatio{.least = 1e-6, .most = 1e6};
};

/// Studies how much accuracy the lattice of cemented grains loses if a coarser lattice or a cheaper solution saves
/// processor time. Packings are made by the scene from successive seeds; the grains of the last state of each are
/// cemented, and loaded by a stress of one along the last axis. The reference is the finest lattice with the strictest
/// tolerance. Elements have spring constants in 2D and moduli in 3D (ElementStiffness::by_facet), with which the moduli of
/// a regular lattice do not depend on its spacing. Costs are those of the lattice and its solution, without the packing. The error of a sample is its
/// difference from the reference of the same packing.
/// @throws InputError as study_tradeoff(), and if the matrix content is invalid or cannot be reached
Tradeoff study_lattice(Scene scene, const LatticeStudyOptions& lattice, const TradeoffOptions& options);

}  // namespace floc
