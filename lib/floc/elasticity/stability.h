#pragma once

#include <optional>
#include <string>

#include "floc/network/contact_network.h"
#include "floc/packing/packing.h"

namespace floc {

/// How far a test of stability may go. The cost of a test is predicted before it starts.
struct StabilityOptions {
  double largest_factor = 4e9;    ///< bytes
  double most_operations = 1e12;  ///< of a factor, or of an iterative test: minutes of one core
  /// Without a factor: a state counts as stable when no eigenvalue of the stiffness matrix, its diagonal scaled
  /// to 1, lies below minus this. Where a grain has left its contacts, as at the end of a tail of attraction,
  /// the lowest is of the order of F0/(D0 K_N), some 1e-2.
  double bound = 1e-4;
};

/// What is known about the stability of a state.
struct Stability {
  /// Negative eigenvalues of the stiffness matrix: 0 for a stable state; no value where it was not tested, or
  /// where an iterative test did not get as far as the bound asked for. An iterative test that finds one gives
  /// 1 and looks for no other.
  std::optional<int> n_negative;
  /// How the test was made and how far it goes, or why there was none, in words; empty where the count is that
  /// of a factor.
  std::string note;

  /// No sign of instability: that a state has not been tested is no reason to refuse it.
  bool may_be_stable() const { return n_negative.value_or(0) == 0; }
};

/// Negative eigenvalues of the stiffness matrix of a network, grains and diagonal strains, after rigid
/// translations, rattlers and free rollers are removed. Mechanisms do not count. By inertia alone: a Cholesky
/// factor that succeeds shows that there is none, else the signs of L S L^T are counted; a network
/// without negative stiffness needs neither. Where a factor would be too expensive, Lanczos' method looks for a
/// direction of negative curvature (test_positivity()).
template <int Dim>
[[nodiscard]] Stability stability(const ContactNetwork<Dim>& network, const StabilityOptions& options = {});

/// The same with the geometric terms of all forces and moments that the network carries. With tangential forces
/// the tangent is not symmetric; its symmetric part is tested, which says whether the second-order work of every
/// motion is positive, and all motions need work from outside [Hill1958].
/// @param stress  load_stress() of the state, which the strains convect
template <int Dim>
[[nodiscard]] Stability stability(const ContactNetwork<Dim>& network, const Mat<Dim>& stress,
                                  const StabilityOptions& options = {});

/// The same for a packing without its rattlers, see ModuliOptions::loaded_network(). Without prestress only
/// distant attractions can make it unstable.
template <int Dim>
[[nodiscard]] Stability stability(const Packing<Dim>& packing, bool prestress = false,
                                  const StabilityOptions& options = {});

/// The test that a packing at rest has to pass to be an equilibrium. With liquid bridges it includes the
/// geometric terms: they pull across gaps comparable to their decay length, so the stiffness F/r across a pull
/// may exceed the negative one along it. A tail of attraction is so short that there these terms are left out.
template <int Dim>
[[nodiscard]] Stability stability_at_rest(const Packing<Dim>& packing);

}  // namespace floc
