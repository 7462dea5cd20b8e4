#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// Kind of a free motion, a motion that needs no energy.
enum class FreeMotionKind {
  rattler,      ///< any motion of a grain without contact
  translation,  ///< translation of a connected part of the network as a whole
  /// rotation, as a whole, of a connected part that does not wind around the cell in the plane of the rotation
  rotation,
  roll,  ///< rolling, sliding or twisting of a dead end on its single contact
  /// rotation of grains that nothing resists although they are not dead ends: they have no friction, or rotate about
  /// the line through their two contacts (3D)
  spin,
};

/// Free motions of a network: motions that need no energy, for any values of the nonzero stiffnesses. They follow from
/// the list of grains in contact. If one unknown is left out for each free motion, the stiffness matrix K is regular,
/// unless the network has mechanisms.
struct FreeMotions {
  /// For each unknown of K, whether it is solved for. Unknowns that are not solved for are set to zero, because free
  /// motions make their values arbitrary.
  std::vector<bool> kept;
  /// For each grain, whether it is a dead end: it has a single contact, or has a single contact left after other dead
  /// ends have been removed. Dead ends take no part in the response to a strain.
  std::vector<bool> dead_end;
  int n_alone = 0;  ///< number of grains that have no contact after the dead ends have been removed
  /// number of dead ends that roll or slide at their single contact without resistance
  int n_free_rollers = 0;
  /// number of groups of grains that rotate together without resistance, not counting dead ends
  int n_free_spins = 0;
  /// number of connected parts of the network after dead ends have been removed; each part can translate unless walls
  /// hold it
  int n_components = 0;
  int n_free_rotations = 0;  ///< number of free rotations of connected parts as rigid bodies
  /// Number of dead ends that only an attraction across a gap holds. Each of them gives K a negative eigenvalue, which
  /// is removed with the dead end.
  int n_unstable_ends = 0;
  /// The free motions, one per column, linearly independent; the rows are the unknowns of K (length, radians). K *
  /// modes is zero to rounding, for translations also with prestress. Dead ends move with the grain that holds them.
  Eigen::SparseMatrix<double> modes;
  std::vector<FreeMotionKind> kind;  ///< kind of each column of `modes`

  int n_dead_ends() const;
  int count(FreeMotionKind of_kind) const;
};

/// Finds the free motions of a network, in three steps:
/// 1. Dead ends are removed, grain by grain from the tips.
/// 2. Rotations of grains that nothing resists are fixed, and are not solved for.
/// 3. For each rigid motion of each connected part, one unknown is fixed. The rigid motions are the Dim translations
///    and the rotations. A part that winds around the cell only has the rotations that fit its periodic images, and a
///    part that touches walls only has the motions that the walls do not resist.
///
/// The response to a strain does not change. The inertia of K changes only by `n_unstable_ends`, because eliminating
/// the unknowns of a dead end from K adds nothing to the unknowns of the grain that holds it. With prestress, this is
/// true if the dead end is in equilibrium, that is, carries no force.
template <int Dim>
FreeMotions find_free_motions(const ContactNetwork<Dim>& network);

}  // namespace floc
