#pragma once

#include <optional>
#include <string>

#include "floc/network/contact_network.h"
#include "floc/packing/packing.h"

namespace floc {

/// Limits on the cost of a stability test. The cost is predicted before the test starts.
struct StabilityOptions {
  double largest_factor = 4e9;  ///< largest size of a factor of the stiffness matrix (bytes)
  /// largest number of floating-point operations of a test (1e12: minutes on one core)
  double most_operations = 1e12;
  /// Tolerance of the iterative test, which replaces a factor that would be too expensive: a state counts as stable if
  /// no eigenvalue of the stiffness matrix, scaled to a diagonal of 1, is below minus this value. Real instabilities
  /// have far lower eigenvalues. For example, if a grain is at the distance from its neighbours at which the attraction
  /// ends, the lowest eigenvalue is of the order of -F0/(D0 K_N), about -1e-2, with the pull-off force F0, the range D0
  /// of the attraction and the normal stiffness K_N.
  double bound = 1e-4;
};

/// Result of a stability test.
struct Stability {
  /// Number of negative eigenvalues of the stiffness matrix; 0 for a stable state. An iterative test stops at the first
  /// negative eigenvalue, so that the number is 1. Absent if the state was not tested, or if an iterative test did not
  /// reach its tolerance.
  std::optional<int> n_negative;
  /// Method and result of the test or, if there was no test, the reason, as a sentence. Empty if a factor of the
  /// stiffness matrix was used.
  std::string note;

  /// Returns whether no instability has been found. A state that has not been tested is accepted.
  bool may_be_stable() const { return n_negative.value_or(0) == 0; }
};

/// Counts the negative eigenvalues of the stiffness matrix of a network. The unknowns of the matrix are the motions of
/// the grains and the diagonal strains of the cell. Motions that cost no energy do not count: mechanisms, rigid
/// translations, and the motions of rattlers and free rollers. The first rule that applies gives the number:
/// 1. If no contact has a negative stiffness, the number is zero.
/// 2. If a factor would be too expensive, Lanczos' method searches for a motion of negative energy (test_positivity()).
/// 3. If the matrix has a Cholesky factor, the number is zero.
/// 4. Otherwise it equals the number of negative entries of the diagonal matrix S in the factorization L S L^T.
template <int Dim>
[[nodiscard]] Stability stability(const ContactNetwork<Dim>& network, const StabilityOptions& options = {});

/// Tests the stability of a network with prestress, that is, with the geometric terms of all contact forces and
/// moments. With tangential forces the tangent matrix is not symmetric, and its symmetric part is tested. If this part
/// is positive, the second-order work of every motion is positive, and no motion starts without external work
/// [Hill1958].
/// @param stress  load_stress() of the state, compression positive (force/length^(Dim-1))
template <int Dim>
[[nodiscard]] Stability stability(const ContactNetwork<Dim>& network, const Mat<Dim>& stress,
                                  const StabilityOptions& options = {});

/// Tests the stability of a packing without its rattlers, see ModuliOptions::loaded_network(). Without prestress, only
/// attractions across gaps can make a packing unstable.
/// @param prestress  whether the geometric terms of the contact forces count
template <int Dim>
[[nodiscard]] Stability stability(const Packing<Dim>& packing, bool prestress = false,
                                  const StabilityOptions& options = {});

/// Tests the stability of a packing at rest. Stability is a condition of equilibrium.
/// - With liquid bridges, the test includes the geometric terms of the forces. The length r of a bridge is comparable
///   to the length over which the force F of the bridge decays. Therefore the transverse stiffness F/r may exceed the
///   magnitude of the negative normal stiffness.
/// - Without liquid, the geometric terms are left out, because the range of the attraction is short compared with r.
template <int Dim>
[[nodiscard]] Stability stability_at_rest(const Packing<Dim>& packing);

}  // namespace floc
