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

/// Kind of a mode, by its eigenvalue.
enum class ModeKind {
  unstable,        ///< negative
  mechanism,       ///< zero to rounding, beyond the motions that are free by structure
  near_mechanism,  ///< below max |F_N|/r: prestress of the size present could change its sign
  elastic,         ///< above max |F_N|/r
};

/// Returns "unstable", "mechanism", "near-mechanism" or "elastic".
std::string name_of(ModeKind kind);

/// One eigenvector of the stiffness matrix of the grains, with strains clamped and without prestress. Rotations
/// are measured as displacements: multiplied by the grain's size.
template <int Dim>
struct Mode {
  ModeKind kind = ModeKind::elastic;
  double eigenvalue = 0.0;      ///< energy is half of it times the squared length of the motion (force/length)
  double with_prestress = 0.0;  ///< Rayleigh's quotient of this motion once the geometric terms are added
  Eigen::VectorXd motion;       ///< unknowns of K (length, radians), of unit length
  /// (sum u_i^2)^2/(n sum u_i^4) over the n grains that take part in the network: 1 if all move alike, 1/n if
  /// one moves.
  double participation = 0.0;
  /// Coupling to strain: volume times stress per unit amplitude, one entry per strain unknown (force). A mode
  /// takes coupling * coupling^T/(eigenvalue volume) off the affine moduli; all modes together leave C.
  Eigen::VectorXd coupling;
  double softens_B = 0.0;  ///< decrease of the affine bulk modulus by this mode (stress)
  double softens_G = 0.0;  ///< decrease of the affine shear modulus (C11 + C22 - 2 C12)/4 (stress)
  /// Fewest grains that hold half of the squared amplitude, the most mobile first, at most `kMaxNamed`.
  std::vector<int> grains;

  static constexpr int kMaxNamed = 12;
};

struct ModeOptions {
  StrainSet strains = StrainSet::diagonal;
  /// Number of modes. By default all that are not elastic, but no fewer than 10 and no more than 100.
  std::optional<int> count;
  static constexpr WholeRange kCount{.least = 1, .most = std::numeric_limits<int>::max()};
  /// Eigenvalues within this of zero, in units of the largest contact stiffness, are mechanisms. They are sums
  /// of squares over the contacts, which the rounding of K does not enter: near-mechanisms show their
  /// eigenvalues down to this bound, and mechanisms are seen at 1e-19 and below.
  double mechanism_bound = 1e-16;
  Ordering ordering = Ordering::amd;
};

template <int Dim>
struct SoftModes {
  FreeMotions free;
  std::vector<Mode<Dim>> modes;  ///< eigenvalues ascending
  double near_bound = 0.0;       ///< max |F_N|/r over the contacts (force/length)
  int n_below_near_bound = 0;  ///< modes up to it, counted by inertia: unstable, mechanisms and near-mechanisms
  bool complete = true;        ///< no mode below the last of these is missing
};

/// Finds the softest modes of a network beyond those that are free by structure, by shift and invert.
/// @throws InputError unless options.count, if given, is positive
template <int Dim>
[[nodiscard]] SoftModes<Dim> soft_modes(const ContactNetwork<Dim>& network, const ModeOptions& options);

/// Counts the near-mechanisms: eigenvalues up to max |F_N|/r, counted by inertia, that belong neither to free
/// motions nor to mechanisms and are not negative. This costs a factor as large as that of the response.
/// @param response        of the same network, strains clamped or not, without prestress
/// @param largest_factor  bytes that the factor may take; no value where it would take more
template <int Dim>
std::optional<int> count_near_mechanisms(const ContactNetwork<Dim>& network, const ElasticResponse& response,
                                         double largest_factor = std::numeric_limits<double>::infinity());

}  // namespace floc
