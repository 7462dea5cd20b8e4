#pragma once

#include <array>
#include <optional>
#include <vector>

#include "floc/network/carrying_structure.h"
#include "floc/shape/manifold.h"

namespace floc {

/// A pair of grains in contact. All its force-carrying contact points together count as one contact.
struct ContactPair {
  /// kind of contact (vertex, edge or face), which follows from the number of carrying points
  ContactType kind;
  double normal_force;  ///< sum of the normal forces of the points of this pair (force)
  int n_points;         ///< number of carrying points of this pair
};

/// Returns the pairs of grains that are joined by force-carrying contacts. A pair with one carrying point is a contact
/// of a vertex and a face, or of two crossing edges; the contact stores which of the two it is. A pair with two points
/// is a contact of two faces (sides) in 2D, and of an edge and a face in 3D. A pair with more points is a contact of
/// two faces.
/// @param carrying  force-carrying structure; contacts with walls are left out
/// @return the pairs, in the order of the contacts
template <int Dim>
std::vector<ContactPair> contact_pairs(const Packing<Dim>& packing, const CarryingStructure& carrying);

/// Coordination number of pairs in contact, and shares of the kinds of contact. The arrays are indexed by ContactType.
struct ContactKinds {
  double z = 0.0;  ///< twice the number of pairs divided by the number of grains that are not rattlers
  std::array<double, 4> share = {};  ///< for each kind: its share of the number of pairs
  std::array<double, 4> force = {};  ///< for each kind: its share of the sum of the normal forces
};

ContactKinds contact_kinds(const std::vector<ContactPair>& pairs, int n_held);

/// Shape of the distribution of the normal forces x, in units of their mean. The joined form of the probability density
/// is k x^-alpha below the mean and k exp[beta (1 - x)] above it, where k and beta follow from two conditions, norm 1
/// and mean 1: beta^2 = (1 - alpha)(2 - alpha) [RTV2010]. All errors are standard errors.
struct ForceShape {
  double below_mean = 0.0;      ///< share of the forces below their mean
  std::optional<double> alpha;  ///< maximum likelihood estimate of alpha in the joined form
  std::optional<double> alpha_error;
  /// decay rate above the mean, estimated from the forces x > 1 alone: 1/(<x> - 1), with their mean <x>
  std::optional<double> beta;
  std::optional<double> beta_error;
};

/// Returns the shape of the distribution of forces. A parameter is absent if there are fewer than 10 forces from which
/// to estimate it.
/// @param forces  forces > 0
ForceShape force_shape(const std::vector<double>& forces);

/// Anisotropies of contacts with respect to the axes of the deviatoric stress. The probability density P of the
/// direction n of a contact, the mean normal force f_n, the mean tangential force f_t, and the normal and tangential
/// components l_n and l_t of the branch vector between the centres depend on n to first order as
///
///     P(n) ~ 1 + n.A n,   f_n ~ 1 + n.B n,   f_t ~ C n - n (n.C n),
///
/// with symmetric traceless tensors A, B and C. The component l_n has the same form as f_n, and l_t the same form as
/// f_t. Tangential quantities are in units of the means of f_n and l_n. Each anisotropy in this struct is the component
/// a of one of these tensors along the deviatoric stress. It is normalised so that P ~ 1 + a cos 2t (2D) or P ~ 1 + a
/// (3 cos^2 t - 1) (3D), and f_t ~ a sin 2t, where t is the angle between n and the direction of the largest stress
/// [RB1989, ARS2009].
struct ContactAnisotropy {
  double normals = 0.0;
  double normal_force = 0.0, tangential_force = 0.0;
  double branch_normal = 0.0, branch_tangential = 0.0;
  /// Ratio q/p of the stress of the contacts, with p the mean stress. In 2D, q is half the difference of the principal
  /// stresses. In 3D, q is |dev sigma|/sqrt(6); under axial symmetry, this is a third of the difference of the
  /// principal stresses.
  double stress_ratio = 0.0;
  /// Ratio q/p predicted by the anisotropies to first order: half of the sum of the anisotropies in 2D, two fifths of
  /// this sum in 3D.
  double predicted_ratio = 0.0;
};

/// Returns the anisotropies of the force-carrying contacts between grains. The result is absent if there is no such
/// contact, or if the deviatoric stress is below 1e-4 of the mean stress.
template <int Dim>
std::optional<ContactAnisotropy> contact_anisotropy(const Packing<Dim>& packing,
                                                    const CarryingStructure& carrying);

/// Returns the ratio of the tangential force to Coulomb's limit, averaged over the force-carrying contacts with
/// friction; absent if there are no such contacts.
template <int Dim>
std::optional<double> mean_mobilisation(const Packing<Dim>& packing, const CarryingStructure& carrying);

}  // namespace floc
