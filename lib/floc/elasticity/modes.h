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

/// Kind of a mode (an eigenvector of the stiffness matrix), according to the eigenvalue of the mode.
enum class ModeKind {
  unstable,   ///< eigenvalue below zero
  mechanism,  ///< eigenvalue zero within rounding errors (free motions, see FreeMotions, do not count as modes)
  /// positive eigenvalue up to max |F_N|/r, the largest ratio of normal force to distance between centres; prestress
  /// could make an eigenvalue of this size negative
  near_mechanism,
  elastic,  ///< eigenvalue above max |F_N|/r, the largest ratio of normal force to distance between centres
};

/// Returns the name of a kind of mode: "unstable", "mechanism", "near-mechanism" or "elastic".
std::string name_of(ModeKind kind);

/// Mode of a network: eigenvector of the stiffness matrix of the grains, without prestress, for strains of the cell
/// that are fixed at zero. In the stiffness matrix, rotations are multiplied by the grain's size.
template <int Dim>
struct Mode {
  ModeKind kind = ModeKind::elastic;
  /// eigenvalue (force/length): twice the elastic energy divided by the squared length of `motion`
  double eigenvalue = 0.0;
  /// twice the energy of the mode with the geometric terms of the prestress, divided by the squared length of `motion`
  /// (force/length)
  double with_prestress = 0.0;
  /// displacements (length) and rotations (radians) of all grains; a unit vector if rotations are multiplied by the
  /// grain's size
  Eigen::VectorXd motion;
  /// Participation ratio (sum u_i^2)^2/(n sum u_i^4), with the amplitudes u_i of the n grains that have a contact: 1 if
  /// all grains move equally, 1/n if a single grain moves.
  double participation = 0.0;
  /// Coupling to strain: the stress that the mode causes per unit amplitude, times the volume; one entry per strain
  /// (force). The mode reduces the moduli of affine motion by coupling * coupling^T/(eigenvalue * volume); all modes
  /// together reduce them to the moduli C of the relaxed network.
  Eigen::VectorXd coupling;
  double softens_B = 0.0;  ///< decrease of the bulk modulus of affine motion that this mode causes (stress)
  /// decrease of the shear modulus (C11 + C22 - 2 C12)/4 of affine motion that this mode causes (stress)
  double softens_G = 0.0;
  /// Smallest set of grains that together have half of the squared amplitude of the mode, in descending order of
  /// amplitude; at most `kMaxNamed` grains.
  std::vector<int> grains;

  static constexpr int kMaxNamed = 12;
};

struct ModeOptions {
  StrainSet strains = StrainSet::diagonal;
  /// Number of modes to compute. If absent: all modes that are not ModeKind::elastic, but at least 10 and at most 100.
  std::optional<int> count;
  static constexpr WholeRange kCount{.least = 1, .most = std::numeric_limits<int>::max()};
  /// Largest absolute eigenvalue that counts as a mechanism, as a share of the largest contact stiffness. The share can
  /// be so small because eigenvalues are recomputed as sums of squares over the contacts, without the rounding errors
  /// of the stiffness matrix. Mechanisms have been seen at 1e-19 and below.
  double mechanism_bound = 1e-16;
  Ordering ordering = Ordering::amd;
};

template <int Dim>
struct SoftModes {
  FreeMotions free;
  std::vector<Mode<Dim>> modes;  ///< modes in ascending order of their eigenvalues
  /// max |F_N|/r over the contacts, with normal force F_N and distance r between centres (force/length)
  double near_bound = 0.0;
  /// number of modes with eigenvalues up to `near_bound` (unstable modes, mechanisms and near-mechanisms), counted from
  /// the inertia (the signs of the eigenvalues) of the stiffness matrix shifted by this bound
  int n_below_near_bound = 0;
  /// whether `modes` contains every mode whose eigenvalue is below the largest eigenvalue in `modes`
  bool complete = true;
};

/// Finds the softest modes of a network by Lanczos' method with shift and invert. Free motions (see FreeMotions) do not
/// count as modes.
/// @throws InputError if options.count is given and not positive
template <int Dim>
[[nodiscard]] SoftModes<Dim> soft_modes(const ContactNetwork<Dim>& network, const ModeOptions& options);

/// Counts the near-mechanisms of a network. These modes are neither free motions nor mechanisms, and their positive
/// eigenvalues are at most max |F_N|/r, the largest ratio of normal force to distance between centres. The count
/// follows from the inertia (the signs of the eigenvalues) of the shifted stiffness matrix. It requires a factor as
/// large as the factor of the elastic response.
/// @param response        response of the same network without prestress, for any strains
/// @param largest_factor  largest size of the factor (bytes)
/// @return no value if the factor would be larger than allowed
template <int Dim>
std::optional<int> count_near_mechanisms(const ContactNetwork<Dim>& network, const ElasticResponse& response,
                                         double largest_factor = std::numeric_limits<double>::infinity());

}  // namespace floc
