#pragma once

#include <vector>

#include "floc/lattice/lattice_network.h"

namespace floc {

/// Isotropic phase (component) of a composite, and its share of the volume. In 2D the bulk modulus K is the bulk
/// modulus of a sheet, E/(2(1 - nu)) with Young's modulus E and Poisson's ratio nu.
struct ElasticPhase {
  double share;  ///< share of the volume, 0 to 1
  double K, G;   ///< bulk and shear modulus (stress); 0 for voids
};

/// Bounds on one modulus of a composite (stress).
struct ModulusBounds {
  /// bounds, from the highest to the lowest (stress)
  double voigt, hashin_shtrikman_upper, hashin_shtrikman_lower, reuss;
};

/// Bounds on the bulk modulus K and shear modulus G of an isotropic composite of isotropic phases that are bonded to
/// each other. In the bounds of Hashin and Shtrikman, the reference phase is the stiffest phase for the upper bound,
/// and the softest phase for the lower bound. If there are voids, the lower bounds are zero. Phases whose share is a
/// rounding error do not count.
struct CompositeBounds {
  ModulusBounds K, G;
};

/// Computes the bounds on the moduli of a composite.
/// @param phases     phases of the composite, whose shares of the volume add up to 1
/// @param dimension  2 or 3
CompositeBounds composite_bounds(const std::vector<ElasticPhase>& phases, int dimension);

/// Whether the bounds of the phases of a cemented sample also bound the moduli of its lattice. The bounds assume that
/// the phases are bonded to each other. Elements at interfaces and contacts that are stiffer than bonded phases raise
/// the moduli, so that the upper bounds do not hold. Softer, open or missing elements lower the moduli, so that the
/// lower bounds do not hold; bounds of zero always hold.
struct BoundsThatHold {
  bool upper = true, lower = true;
};

/// Returns which bounds of the phases of a sample bound the moduli of its lattice.
/// @param n_open  number of open elements, which carry no force
template <int Dim>
BoundsThatHold bounds_that_hold(const LatticeNetwork<Dim>& network, const ElementStiffness& stiffness,
                                int n_open);

/// Returns the moduli of a triangular lattice of springs with normal and tangential stiffnesses k_n and k_t: K =
/// sqrt(3)/2 k_n and G = sqrt(3)/4 (k_n + k_t). The moduli do not depend on the spacing or the bending stiffness.
/// @param share   share of the volume of the composite, copied to the returned phase
/// @param kn, kt  stiffnesses k_n and k_t (force/length)
ElasticPhase triangular_moduli(double share, double kn, double kt);

}  // namespace floc
