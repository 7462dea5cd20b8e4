#pragma once

#include <vector>

namespace floc {

/// An isotropic phase of a composite and its share of the volume. In 2D K is the modulus of a sheet, E/(2(1 -
/// nu)).
struct ElasticPhase {
  double share;
  double K, G;  ///< bulk and shear modulus (stress); 0 for voids
};

struct ModulusBounds {
  double voigt, hashin_shtrikman_upper, hashin_shtrikman_lower, reuss;  ///< (stress)
};

/// Bounds on the bulk and shear modulus of an isotropic composite of isotropic phases that stick together. The
/// bounds of Hashin and Shtrikman take the stiffest and the softest phase as reference; with voids the lower
/// ones vanish.
struct CompositeBounds {
  ModulusBounds K, G;
};

/// Computes the bounds of a composite. @param phases  phases whose shares add up to 1   @param dimension  2 or
/// 3
CompositeBounds composite_bounds(const std::vector<ElasticPhase>& phases, int dimension);

/// Returns the moduli of the triangular lattice, K = sqrt(3)/2 k_n and G = sqrt(3)/4 (k_n + k_t), which do not
/// depend on its spacing or bending stiffness.
ElasticPhase triangular_moduli(double share, double kn, double kt);

}  // namespace floc
