#pragma once

#include "floc/tradeoff/tradeoff.h"

namespace floc {

/// Options of a study of cemented grains, which are modelled as a lattice.
struct LatticeStudyOptions {
  double matrix_content = 0.1;  ///< fraction of the volume that the matrix fills
  /// stiffness of the elements in grains, divided by the stiffness of the elements in the matrix
  double stiffness_ratio = 100.0;
  static constexpr NumberRange kRatio{.least = 1e-6, .most = 1e6};
};

/// Studies the errors of the lattice of cemented grains: how they grow with a coarser lattice or a cheaper solution
/// method, and how much processor time is saved. Packings are made from the scene with successive seeds. In the last
/// state of each packing, the grains are cemented and loaded by a stress of 1 along the last axis. The reference is the
/// finest lattice with the strictest tolerance. The error of a sample is its difference from the reference for the same
/// packing. The processor time includes making and solving the lattice, but not making the packing.
///
/// The stiffness of an element is a spring constant in 2D and a modulus in 3D (ElementStiffness::by_facet). With this
/// choice the moduli of a regular lattice do not depend on its spacing.
/// @throws InputError under the conditions of study_tradeoff(), and if the matrix content is invalid or cannot be
/// reached
Tradeoff study_lattice(Scene scene, const LatticeStudyOptions& lattice, const TradeoffOptions& options);

}  // namespace floc
