#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// Kind of a free motion, a motion that needs no energy.
enum class FreeMotionKind {
  rattler,      ///< motion of a grain without contact
  translation,  ///< translation of a connected part of the network as a whole
  /// rotation of a connected part as a whole, which does not wind around the cell in the plane of rotation
  rotation,
  roll,  ///< rolling, sliding or twisting of a dead end on its single contact
  /// rotation of grains that are no dead ends: without friction, or about the line through two contacts (3D)
  spin,
};

/// Free motions of a network: motions that need no energy, whatever the nonzero stiffnesses are; they follow from which
/// grains are in contact. If their unknowns are left out, the stiffness matrix K is regular unless the network has
/// mechanisms.
struct FreeMotions {
  /// For each unknown of K, whether it is solved for. The others are set to zero: free motions make them arbitrary.
  std::vector<bool> kept;
  /// For each grain, whether it is a dead end: it has a single contact, or would have one without other dead ends. Dead
  /// ends take no part in the response to a strain.
  std::vector<bool> dead_end;
  int n_alone = 0;         ///< number of grains that have no contact after the dead ends have been removed
  int n_free_rollers = 0;  ///< number of dead ends that roll or slide on their contact without resistance
  int n_free_spins = 0;    ///< number of groups of grains, no dead ends, that spin together without resistance
  /// number of connected parts without dead ends; each can translate unless walls hold it
  int n_components = 0;
  int n_free_rotations = 0;  ///< number of free rotations of connected parts as rigid bodies
  /// Number of negative eigenvalues of K that are removed with the dead ends: dead ends that are held by an attraction
  /// across a gap alone.
  int n_unstable_ends = 0;
  /// The free motions as linearly independent columns; rows are the unknowns of K (length, radians). K * modes = 0 to
  /// rounding (for translations also with prestress). Dead ends move with the grain that holds them.
  Eigen::SparseMatrix<double> modes;
  std::vector<FreeMotionKind> kind;  ///< kind of each column of `modes`

  int n_dead_ends() const;
  int count(FreeMotionKind of_kind) const;
};

/// Finds the free motions of a network, in three steps:
/// 1. Dead ends are removed, grain by grain from the tips.
/// 2. Rotations of grains that nothing resists are fixed: their unknowns are not solved for.
/// 3. For each rigid motion of each connected part, one unknown is fixed. These motions are the Dim translations, and
///    the rotations that agree with the periodic images of the part if it winds around the cell; if the part touches
///    walls, only motions that the walls do not resist.
///
/// The response to strain does not change. The inertia of K does not change either, except for `n_unstable_ends`: if
/// the unknowns of a tip are eliminated from K, nothing is added to those of its neighbour. With prestress this holds
/// if the tip is in equilibrium, that is, carries no force.
template <int Dim>
FreeMotions find_free_motions(const ContactNetwork<Dim>& network);

}  // namespace floc
