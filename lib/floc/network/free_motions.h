#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// Kind of a free motion, a motion that needs no energy.
enum class FreeMotionKind {
  rattler,      ///< any motion of a grain without contact
  translation,  ///< translation of a connected part of the network as a whole
  /// rotation of a connected part as a whole; the part does not wind around the cell in the plane of the rotation
  rotation,
  roll,  ///< rolling, sliding or twisting of a dead end at its single contact
  /// free rotation of grains that are not dead ends: grains without friction, or (in 3D) a grain that rotates about the
  /// line through its two contacts
  spin,
};

/// Free motions of a network: motions that need no energy, for any values of the nonzero stiffnesses. The list of
/// grains in contact determines these motions. If one unknown is left out for each free motion, the stiffness matrix K
/// is regular, except if the network has mechanisms.
struct FreeMotions {
  /// For each unknown of K, whether it is solved for. All other unknowns are set to zero; their values are arbitrary,
  /// because of the free motions.
  std::vector<bool> kept;
  /// For each grain, whether it is a dead end: it has a single contact, or has a single contact left after other dead
  /// ends have been removed. A strain of the cell causes no forces in dead ends.
  std::vector<bool> dead_end;
  int n_alone = 0;  ///< number of grains that have no contact after the dead ends have been removed
  /// number of dead ends that roll or slide at their single contact without resistance
  int n_free_rollers = 0;
  /// number of groups of grains that rotate together without resistance, not counting dead ends
  int n_free_spins = 0;
  /// number of connected parts of the network after dead ends have been removed; each part can translate, except if
  /// walls prevent it
  int n_components = 0;
  int n_free_rotations = 0;  ///< number of free rotations of connected parts as rigid bodies
  /// Number of dead ends whose single contact is an attraction across a gap. Each of them causes a negative eigenvalue
  /// of K, which is removed together with the dead end.
  int n_unstable_ends = 0;
  /// Matrix with linearly independent free motions as columns; the rows are the unknowns of K (length, radians). K *
  /// modes is zero up to rounding. For translations, this is true even with prestress. Dead ends move together with the
  /// grain to which they are connected.
  Eigen::SparseMatrix<double> modes;
  std::vector<FreeMotionKind> kind;  ///< kind of each column of `modes`

  int n_dead_ends() const;
  int count(FreeMotionKind of_kind) const;
};

/// Finds the free motions of a network, in three steps:
/// 1. Dead ends are removed, grain by grain, beginning at the tips.
/// 2. Free rotations of grains, which no force or moment resists, are fixed and not solved for.
/// 3. For each rigid motion of each connected part, one unknown is fixed. The rigid motions are the Dim translations
///    and the rotations. A part that winds around the cell has only those rotations in which it remains connected to
///    its periodic images. A part that touches walls has only those motions that the walls do not resist.
///
/// Leaving out the unknowns of the dead ends and the fixed unknowns does not change the response to a strain. The
/// number of negative eigenvalues of K decreases only by `n_unstable_ends`. The reason is that eliminating the unknowns
/// of a dead end from K adds nothing to the block of its neighbour. With prestress, this is true if the dead end is in
/// equilibrium, that is, if the force at its contact is zero.
template <int Dim>
FreeMotions find_free_motions(const ContactNetwork<Dim>& network);

/// Returns whether a contact resists the rotation of one of its grains about any axis: it has a tangential, rolling or
/// twisting stiffness, or its normal force has a moment about the centre of the grain, as between grains with corners.
template <int Dim>
bool resists_rotation(const ContactNetwork<Dim>& network, const NetworkContact<Dim>& contact, int grain);

}  // namespace floc
