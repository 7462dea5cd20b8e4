#pragma once

#include <optional>
#include <string>

#include "floc/network/contact_network.h"
#include "floc/packing/packing.h"

namespace floc {

/// Limits on the cost of a test of stability. The cost is predicted before the test starts.
struct StabilityOptions {
  double largest_factor = 4e9;  ///< largest size of a factor (bytes)
  double most_operations =
      1e12;  ///< largest number of floating-point operations of a test (1e12: minutes on one core)
  /// Tolerance of the iterative test: a state counts as stable if no eigenvalue of the stiffness matrix, scaled to a
  /// diagonal of 1, is below minus this value. If a grain has separated from its neighbours to the end of the range D0
  /// of an attraction with the force F0 at contact, the lowest eigenvalue is of the order of F0/(D0 K_N), about 1e-2.
  double bound = 1e-4;
};

/// Result of a test of the stability of a state.
struct Stability {
  /// Number of negative eigenvalues of the stiffness matrix; 0 for a stable state. No value if the state was not
  /// tested, or if an iterative test did not reach its tolerance. An iterative test stops at the first negative
  /// eigenvalue and gives 1.
  std::optional<int> n_negative;
  /// Method and result of the test, or the reason why there was no test, as a sentence. Empty if the count comes from a
  /// factor.
  std::string note;

  /// Returns whether no instability has been found. A state that has not been tested is accepted.
  bool may_be_stable() const { return n_negative.value_or(0) == 0; }
};

/// Counts the negative eigenvalues of the stiffness matrix of a network, whose unknowns are the motions of the grains
/// and the diagonal strains, without rigid translations, rattlers and free rollers. Mechanisms do not count. The count
/// comes from the inertia of the matrix: if a Cholesky factorization succeeds, there is no negative eigenvalue;
/// otherwise the signs of S in L S L^T are counted. A network without negative stiffness needs no factorization. If a
/// factor would be too expensive, Lanczos' method searches for a direction of negative curvature (test_positivity()).
template <int Dim>
[[nodiscard]] Stability stability(const ContactNetwork<Dim>& network, const StabilityOptions& options = {});

/// Tests the stability of a network with the geometric terms of all forces and moments that it carries. With tangential
/// forces the tangent matrix is not symmetric, and its symmetric part is tested: if this part is positive, the
/// second-order work of every motion is positive, so that no motion starts without external work [Hill1958].
/// @param stress  load_stress() of the state, compression positive (force/length^(Dim-1))
template <int Dim>
[[nodiscard]] Stability stability(const ContactNetwork<Dim>& network, const Mat<Dim>& stress,
                                  const StabilityOptions& options = {});

/// Tests the stability of a packing without its rattlers, see ModuliOptions::loaded_network(). Without prestress, only
/// attractions across gaps can make a packing unstable.
template <int Dim>
[[nodiscard]] Stability stability(const Packing<Dim>& packing, bool prestress = false,
                                  const StabilityOptions& options = {});

/// Tests the stability of a packing at rest, which is a condition of equilibrium. With liquid bridges the test includes
/// the geometric terms: the length of a bridge is comparable to the decay length of its force F, so that its transverse
/// stiffness F/r may exceed its negative normal stiffness. An attraction that decreases linearly across the gap has so
/// short a range that these terms are left out.
template <int Dim>
[[nodiscard]] Stability stability_at_rest(const Packing<Dim>& packing);

}  // namespace floc
