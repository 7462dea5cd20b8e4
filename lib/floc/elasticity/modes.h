#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/elasticity/elastic_response.h"
#include "floc/linalg/symmetric_factor.h"
#include "floc/network/free_motions.h"
#include "floc/network/stiffness_matrix.h"

namespace floc {

/// Kind of an eigenvector (mode) of the stiffness matrix, by its eigenvalue.
enum class ModeKind {
  unstable,   ///< eigenvalue below zero
  mechanism,  ///< eigenvalue zero to rounding (free motions, see FreeMotions, are no modes)
  near_mechanism,  ///< eigenvalue below max |F_N|/r (normal force over branch length): prestress could change its sign
  elastic,         ///< eigenvalue above max |F_N|/r (normal force over branch length)
};

/// Returns the name of a kind of mode: "unstable", "mechanism", "near-mechanism" or "elastic".
std::string name_of(ModeKind kind);

/// Eigenvector of the stiffness matrix of the grains, with strains fixed at zero and without prestress. Rotations are
/// measured as displacements: they are multiplied by the grain's size.
template <int Dim>
struct Mode {
  ModeKind kind = ModeKind::elastic;
  double eigenvalue = 0.0;  ///< eigenvalue (force/length): twice the energy over the squared length of `motion`
  /// Rayleigh quotient of this motion with prestress, that is, with the geometric terms (force/length)
  double with_prestress = 0.0;
  Eigen::VectorXd motion;  ///< displacements and rotations of all grains (length, radians), of unit length
  /// Participation ratio (sum u_i^2)^2/(n sum u_i^4) over the n grains that take part in the network: 1 if all grains
  /// move equally, 1/n if a single grain moves.
  double participation = 0.0;
  /// Coupling to strain: volume times stress per unit amplitude of the mode, one entry per strain unknown (force). A
  /// mode reduces the affine moduli by coupling * coupling^T/(eigenvalue volume); all modes together reduce them to C.
  Eigen::VectorXd coupling;
  double softens_B = 0.0;  ///< decrease of the affine bulk modulus by this mode (stress)
  double softens_G = 0.0;  ///< decrease of the affine shear modulus (C11 + C22 - 2 C12)/4 (stress)
  /// Grains with the largest amplitudes, in descending order, that together have half of the squared amplitude of the
  /// mode; at most `kMaxNamed`.
  std::vector<int> grains;

  static constexpr int kMaxNamed = 12;
};

struct ModeOptions {
  StrainSet strains = StrainSet::diagonal;
  /// Number of modes to compute. By default all that are not elastic, but no fewer than 10 and no more than 100.
  std::optional<int> count;
  static constexpr WholeRange kCount{.least = 1, .most = std::numeric_limits<int>::max()};
  /// Largest absolute eigenvalue that counts as a mechanism, in units of the largest contact stiffness. Eigenvalues are
  /// recomputed as sums of squares over the contacts, which the rounding of the stiffness matrix does not affect.
  /// Near-mechanisms are therefore resolved down to this bound; mechanisms have been seen at 1e-19 and below.
  double mechanism_bound = 1e-16;
  Ordering ordering = Ordering::amd;
};

template <int Dim>
struct SoftModes {
  FreeMotions free;
  std::vector<Mode<Dim>> modes;  ///< modes in ascending order of their eigenvalues
  double near_bound = 0.0;       ///< max |F_N|/r over the contacts, with branch length r (force/length)
  /// number of unstable modes, mechanisms and near-mechanisms: eigenvalues up to `near_bound`, from the inertia of the
  /// shifted stiffness matrix
  int n_below_near_bound = 0;
  bool complete = true;  ///< whether `modes` contains every mode below its last one
};

/// Finds the softest modes of a network by shift and invert, except for its free motions (see FreeMotions).
/// @throws InputError if options.count is given and not positive
template <int Dim>
[[nodiscard]] SoftModes<Dim> soft_modes(const ContactNetwork<Dim>& network, const ModeOptions& options);

/// Counts the near-mechanisms of a network: positive eigenvalues up to max |F_N|/r that belong neither to free motions
/// nor to mechanisms. The count is taken from the inertia of the shifted stiffness matrix and costs a factor as large
/// as that of the elastic response.
/// @param response        response of the same network without prestress, for any strains
/// @param largest_factor  largest size of the factor (bytes)
/// @return no value if the factor would be larger than allowed
template <int Dim>
std::optional<int> count_near_mechanisms(const ContactNetwork<Dim>& network, const ElasticResponse& response,
                                         double largest_factor = std::numeric_limits<double>::infinity());

}  // namespace floc
