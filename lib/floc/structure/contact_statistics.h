#pragma once

#include <array>
#include <optional>
#include <vector>

#include "floc/network/carrying_structure.h"
#include "floc/shape/manifold.h"

namespace floc {

/// A pair of grains in contact, whose carrying contact points count as one.
struct ContactPair {
  ContactType kind;     ///< features that meet, by the number of carrying points
  double normal_force;  ///< sum of the normal forces of its points (force)
  int n_points;         ///< number of its carrying points
};

/// Returns the pairs of grains that the carrying contacts of a packing join. A pair with one carrying point is one of
/// a vertex and a face, or of two crossing edges, as recorded with the contact; one with two points is one of two faces
/// (sides) in 2D, and of an edge and a face in 3D; one with more is one of two faces.
/// @param carrying  force-carrying structure; contacts with walls are left out
/// @return the pairs, in the order of the contacts
template <int Dim>
std::vector<ContactPair> contact_pairs(const Packing<Dim>& packing, const CarryingStructure& carrying);

/// Numbers of the pairs of each kind, by the index of the ContactType.
struct ContactKinds {
  double z = 0.0;  ///< twice the number of pairs over the number of grains that are not rattlers
  std::array<double, 4> share = {};  ///< share of the pairs that are of each kind
  std::array<double, 4> force = {};  ///< share of the sum of the normal forces that each kind carries
};

ContactKinds contact_kinds(const std::vector<ContactPair>& pairs, int n_held);

/// Distribution of the normal forces x in units of their mean. The joined form of it is k x^-alpha below the mean and k
/// exp[beta (1 - x)] above, where norm and mean 1 give beta^2 = (1 - alpha)(2 - alpha) [RTV2010]. Errors are standard errors.
struct ForceShape {
  double below_mean = 0.0;      ///< share of the forces below their mean
  std::optional<double> alpha;  ///< likeliest alpha of the joined form
  std::optional<double> alpha_error;
  std::optional<double> beta;  ///< decay above the mean by itself: 1/(<x> - 1) over the forces x > 1
  std::optional<double> beta_error;
};

/// Returns the shape of the distribution of forces. Parameters are absent where fewer than 10 forces determine them.
/// @param forces  forces > 0
ForceShape force_shape(const std::vector<double>& forces);

/// Anisotropies of contacts about the axes of the deviatoric stress. With the direction n of a contact, to first order
///
///     P(n) ~ 1 + n.A n,   f_n ~ 1 + n.B n,   f_t ~ C n - n (n.C n),   l_n and l_t likewise,
///
/// for the probability density of n, the normal force, the tangential force and the branch l from centre to centre, with
/// symmetric tensors without trace; f_t and l_t are in units of the means of f_n and l_n. A member is the component of such
/// a tensor along the deviatoric stress. It is normalised as in P ~ 1 + a cos 2t (2D) and P ~ 1 + a (3 cos^2 t - 1) (3D) with
/// f_t ~ a sin 2t, where t is the angle to the direction of the largest stress [RB1989, ARS2009].
struct ContactAnisotropy {
  double normals = 0.0;
  double normal_force = 0.0, tangential_force = 0.0;
  double branch_normal = 0.0, branch_tangential = 0.0;
  /// q/p of the stress of the contacts: p is the mean stress, and q half the difference of the principal stresses in 2D,
  /// |dev sigma|/sqrt(6) in 3D, which is a third of the difference under axial symmetry.
  double stress_ratio = 0.0;
  /// q/p that follows from the anisotropies to first order: half of their sum in 2D, two fifths of it in 3D.
  double predicted_ratio = 0.0;
};

/// Returns the anisotropies of the carrying contacts between grains; absent if there is no contact or the
/// deviatoric stress is below 1e-4 of the mean stress.
template <int Dim>
std::optional<ContactAnisotropy> contact_anisotropy(const Packing<Dim>& packing,
                                                    const CarryingStructure& carrying);

/// Returns the mean of the tangential force over Coulomb's limit, over the carrying contacts that have one; absent if none has.
template <int Dim>
std::optional<double> mean_mobilisation(const Packing<Dim>& packing, const CarryingStructure& carrying);

}  // namespace floc
