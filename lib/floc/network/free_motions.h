#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

enum class FreeMotionKind {
  rattler,      ///< any motion of a grain without contact
  translation,  ///< translation of a connected part as a whole
  rotation,     ///< rotation of a connected part as a whole, which does not wind around the cell in that plane
  roll,         ///< motion of a dead end that rolls on its one contact, slides along it or twists about it
  spin,         ///< spin of grains of the core: without friction, or about the line of two contacts (3D)
};

/// Motions that cost no energy because of how a network is connected, whatever the values of the stiffnesses
/// that do not vanish. The stiffness matrix without them is regular unless the network has true mechanisms.
struct FreeMotions {
  /// Unknowns of K to solve for, one entry per unknown; the others are free and are set to zero.
  std::vector<bool> kept;
  /// Grains that hang on a single contact, or on a chain of such grains: they take no part in the response to a
  /// strain.
  std::vector<bool> dead_end;
  int n_alone = 0;           ///< grains without contact, or left so once their dead ends are gone
  int n_free_rollers = 0;    ///< dead ends that roll on their contact or slide along it at no cost
  int n_free_spins = 0;      ///< groups of other grains that spin together at no cost
  int n_components = 0;      ///< connected parts of what is left; each can translate where no wall holds it
  int n_free_rotations = 0;  ///< rigid rotations of parts that do not wrap around the cell
  /// Negative eigenvalues of K removed with the dead ends: grains held by one distant attraction.
  int n_unstable_ends = 0;
  /// The motions themselves, independent: rows are the unknowns of K (length, radians), one column per motion,
  /// K * modes = 0 to rounding (for translations, with prestress too). Dead ends follow what holds them.
  Eigen::SparseMatrix<double> modes;
  std::vector<FreeMotionKind> kind;  ///< kind of each column of `modes`

  int n_dead_ends() const;
  int count(FreeMotionKind of_kind) const;
};

/// Finds the free motions of a network. First removes dead ends (grain by grain from the tips). Then pins
/// rotations that nothing resists, and one unknown for each rigid motion of each connected component: Dim
/// translations, and the rotations allowed by the ways in which the component winds around the cell; if it
/// touches walls, only the motions that they do not resist. The response to strain does not change, nor does
/// the inertia of K, up to `n_unstable_ends`: the tip's own block of K is eliminated exactly and leaves nothing
/// on its neighbour. With prestress this holds as far as the tip is in equilibrium, that is, carries no force.
template <int Dim>
FreeMotions find_free_motions(const ContactNetwork<Dim>& network);

}  // namespace floc
