#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// Kind of a free motion, which needs no energy.
enum class FreeMotionKind {
  rattler,      ///< motion of a grain without contact
  translation,  ///< translation of a connected part as a whole
  rotation,     ///< rotation of a connected part that does not wind around the cell in the plane of rotation
  roll,         ///< rolling, sliding or twisting of a dead end on its single contact
  spin,  ///< rotation of grains that are no dead ends: without friction, or about the line through two contacts (3D)
};

/// Motions that need no energy because of the connections of a network, for any values of the nonzero stiffnesses.
/// Without them, the stiffness matrix K is regular unless the network has mechanisms.
struct FreeMotions {
  /// For each unknown of K, whether to solve for it. The other unknowns are free and are set to zero.
  std::vector<bool> kept;
  /// For each grain, whether it is a dead end: it hangs on a single contact, or on a chain of such grains. Dead ends
  /// take no part in the response to a strain.
  std::vector<bool> dead_end;
  int n_alone = 0;         ///< number of grains that have no contact once dead ends are removed
  int n_free_rollers = 0;  ///< number of dead ends that roll or slide on their contact without resistance
  int n_free_spins = 0;    ///< number of groups of other grains that spin together without resistance
  int n_components =
      0;  ///< number of connected parts without dead ends; each can translate unless walls hold it
  int n_free_rotations = 0;  ///< number of rigid rotations of parts that do not wind around the cell
  /// Number of negative eigenvalues of K that are removed with the dead ends: grains held by a single attraction across
  /// a gap.
  int n_unstable_ends = 0;
  /// The motions as linearly independent columns; rows are the unknowns of K (length, radians). K * modes = 0 to
  /// rounding (for translations also with prestress). Dead ends move with the grain that holds them.
  Eigen::SparseMatrix<double> modes;
  std::vector<FreeMotionKind> kind;  ///< kind of each column of `modes`

  int n_dead_ends() const;
  int count(FreeMotionKind of_kind) const;
};

/// Finds the free motions of a network. First, dead ends are removed, grain by grain from the tips. Then rotations that
/// nothing resists are fixed (their unknown is not solved for), and one unknown is fixed for each rigid motion of each
/// connected part. These motions are Dim translations and the rotations that are compatible with the winding of the
/// part around the cell; if the part touches walls, only the motions that the walls do not resist. The response to
/// strain does not change. The inertia of K does not change either, except for `n_unstable_ends`: the block of a tip in
/// K is eliminated exactly and leaves nothing on its neighbour. With prestress this holds if the tip is in equilibrium,
/// that is, carries no force.
template <int Dim>
FreeMotions find_free_motions(const ContactNetwork<Dim>& network);

}  // namespace floc
