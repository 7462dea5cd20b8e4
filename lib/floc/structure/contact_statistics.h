#pragma once

#include <array>
#include <optional>
#include <vector>

#include "floc/network/carrying_structure.h"
#include "floc/shape/manifold.h"

namespace floc {

/// A pair of grains in contact. All force-carrying contact points of the pair together count as one contact.
struct ContactPair {
  /// Kind of the contact (vertex, edge or face). It follows from the number of force-carrying points.
  ContactType kind;
  double normal_force;  ///< sum of the normal forces of the points of this pair (force)
  int n_points;         ///< number of force-carrying points of this pair
};

/// Returns the pairs of grains that are joined by force-carrying contacts, with their kind. One force-carrying point is
/// a contact of a vertex and a face, or of two crossing edges; the type of the point in the contact list says which.
/// Two points are a contact of two faces (sides) in 2D, and of an edge and a face in 3D. More points are a contact of
/// two faces.
/// @param carrying  force-carrying structure; contacts with walls are left out
/// @return the pairs, in the order of the contact list
template <int Dim>
std::vector<ContactPair> contact_pairs(const Packing<Dim>& packing, const CarryingStructure& carrying);

/// Coordination number of pairs in contact, and shares of the kinds of contact. The arrays are indexed by ContactType.
struct ContactKinds {
  double z = 0.0;  ///< twice the number of pairs, divided by the number of grains without rattlers
  std::array<double, 4> share = {};  ///< for each kind: its share of the number of pairs
  std::array<double, 4> force = {};  ///< for each kind: its share of the sum of the normal forces
};

ContactKinds contact_kinds(const std::vector<ContactPair>& pairs, int n_held);

/// Shape of the distribution of the normal forces x, in units of their mean. The "joined form" of the probability
/// density is k x^-alpha for x < 1, and k exp[beta (1 - x)] for x > 1. The integral and the mean have to be 1, which
/// determines k, and beta^2 = (1 - alpha)(2 - alpha) [RTV2010]. All errors are standard errors.
struct ForceShape {
  double below_mean = 0.0;      ///< share of the forces below their mean
  std::optional<double> alpha;  ///< maximum likelihood estimate of alpha in the joined form
  std::optional<double> alpha_error;
  /// Decay rate of the density above the mean, estimated as 1/(m - 1), where m is the mean of the forces x > 1.
  std::optional<double> beta;
  std::optional<double> beta_error;
  /// Decay rate above twice the mean, estimated as 1/(m - 2), where m is the mean of the forces x > 2.
  std::optional<double> beta2;
  std::optional<double> beta2_error;
};

/// Returns the shape of the distribution of forces. A parameter is absent if it would be estimated from fewer than 10
/// forces, or if the distribution does not have the joined form.
/// @param forces  forces > 0
ForceShape force_shape(const std::vector<double>& forces);

/// Anisotropies of contacts with respect to the axes of the deviatoric stress. Five quantities depend on the direction
/// n of a contact: the probability density P, the mean normal force f_n, the mean tangential force f_t, and the mean
/// normal and tangential components l_n and l_t of the branch vector. To first order,
///
///     P(n) ~ 1 + n.A n,   f_n ~ 1 + n.B n,   f_t ~ C n - n (n.C n),
///
/// with symmetric traceless tensors A, B and C. The component l_n has the same form as f_n, and l_t the same form as
/// f_t. The unit of f_t is the mean of f_n, and the unit of l_t is the mean of l_n. Each anisotropy in this struct is
/// the component a of one of the tensors along the deviatoric stress. Let t be the angle between n and the direction of
/// the largest stress. The anisotropies are normalised so that P ~ 1 + a cos 2t (2D) or P ~ 1 + a (3 cos^2 t - 1) (3D),
/// and f_t ~ a sin 2t [RB1989, ARS2009].
struct ContactAnisotropy {
  double normals = 0.0;
  double normal_force = 0.0, tangential_force = 0.0;
  double branch_normal = 0.0, branch_tangential = 0.0;
  /// Ratio q/p of the stress of the contacts, with p the mean stress. In 2D, q is half the difference of the principal
  /// stresses. In 3D, q is |dev sigma|/sqrt(6); under axial symmetry, this is a third of the difference of the
  /// principal stresses.
  double stress_ratio = 0.0;
  /// Ratio q/p that the anisotropies predict to first order: their sum times 1/2 in 2D, times 2/5 in 3D.
  double predicted_ratio = 0.0;
};

/// Returns the anisotropies of the force-carrying contacts between grains. The result is absent if there is no such
/// contact, or if the deviatoric stress is below 1e-4 of the mean stress.
template <int Dim>
std::optional<ContactAnisotropy> contact_anisotropy(const Packing<Dim>& packing,
                                                    const CarryingStructure& carrying);

/// Returns the mean, over the force-carrying contacts with friction, of the tangential force divided by Coulomb's
/// limit; absent without such contacts.
template <int Dim>
std::optional<double> mean_mobilisation(const Packing<Dim>& packing, const CarryingStructure& carrying);

}  // namespace floc
