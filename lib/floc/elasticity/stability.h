#pragma once

#include <optional>
#include <string>

#include "floc/network/contact_network.h"
#include "floc/packing/packing.h"

namespace floc {

/// Limits on the cost of a test of stability. The cost is predicted before the test starts.
struct StabilityOptions {
  double largest_factor = 4e9;    ///< largest size of a factor (bytes)
  double most_operations = 1e12;  ///< floating-point, of a factor or an iterative test: minutes of one core
  /// Without a factor: a state counts as stable when no eigenvalue of the stiffness matrix, its diagonal scaled
  /// to 1, lies below minus this. Where a grain has left its contacts, as at the end of a tail of attraction,
  /// the lowest is of the order of F0/(D0 K_N), some 1e-2.
  double bound = 1e-4;
};

/// Result of a test of the stability of a state.
struct Stability {
  /// Negative eigenvalues of the stiffness matrix: 0 for a stable state; no value where it was not tested, or
  /// where an iterative test did not get as far as the bound asked for. An iterative test that finds one gives
  /// 1 and looks for no other.
  std::optional<int> n_negative;
  /// Method and reach of the test, or the reason why there was none, in words; empty where the count is that of
  /// a factor.
  std::string note;

  /// Whether there is no sign of instability. A state that has not been tested is accepted.
  bool may_be_stable() const { return n_negative.value_or(0) == 0; }
};

/// Counts the negative eigenvalues of the stiffness matrix of a network, over the grains and the diagonal
/// strains, after rigid translations, rattlers and free rollers are removed. Mechanisms do not count. The count
/// rests on the inertia of the matrix: a Cholesky factor that succeeds shows that there is no negative
/// eigenvalue, otherwise the signs of S in L S L^T are counted. A network without negative stiffness needs
/// neither. Where a factor would be too expensive, Lanczos' method looks for a direction of negative curvature
/// (test_positivity()).
template <int Dim>
[[nodiscard]] Stability stability(const ContactNetwork<Dim>& network, const StabilityOptions& options = {});

/// Tests the stability with the geometric terms of all forces and moments that the network carries. With
/// tangential forces the tangent is not symmetric. The test is then that of its symmetric part: where that is
/// positive, the second-order work of every motion is positive, so that each needs work from outside
/// [Hill1958].
/// @param stress  load_stress() of the state, which the strains convect
template <int Dim>
[[nodiscard]] Stability stability(const ContactNetwork<Dim>& network, const Mat<Dim>& stress,
                                  const StabilityOptions& options = {});

/// Tests the stability of a packing without its rattlers, see ModuliOptions::loaded_network(). Without
/// prestress only distant attractions can make it unstable.
template <int Dim>
[[nodiscard]] Stability stability(const Packing<Dim>& packing, bool prestress = false,
                                  const StabilityOptions& options = {});

/// Tests the stability of a packing at rest, which is a condition of equilibrium. With liquid bridges the test
/// includes the geometric terms: bridges pull across gaps comparable to their decay length, so the stiffness
/// F/r across a pull may exceed the negative one along it. A tail of attraction is so short that these terms
/// are left out.
template <int Dim>
[[nodiscard]] Stability stability_at_rest(const Packing<Dim>& packing);

}  // namespace floc
