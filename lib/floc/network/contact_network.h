#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// One contact in the form that linear response uses: its points of action on the two bodies, its directions,
/// stiffnesses and forces. Nothing here assumes round grains.
template <int Dim>
struct NetworkContact {
  int i;                ///< first grain
  int j;                ///< second grain; i itself where it touches its own image or a wall
  Vec<Dim, int> image;  ///< lattice vectors by which the image of j is displaced
  /// Vector from the centre of i to that of the image of j (length), which a strain of the boundary stretches.
  /// For a wall: along its normal, to its plane; across it, where there are other walls, from the centre of i
  /// to the middle of the box, since a wall moves along its normal alone.
  Vec<Dim> branch;
  Vec<Dim> arm_i;                      ///< from the centre of i to the contact point (length)
  Vec<Dim> arm_j;                      ///< from the centre of the image of j to the contact point (length)
  Mat<Dim> frame;                      ///< columns: the unit normal from i to j, then the tangents
  double kn;                           ///< K_N, or -F0/D0 of a distant attraction (force/length)
  double kt;                           ///< K_T (force/length)
  double kr;                           ///< K_R (force * length)
  double ktw = 0.0;                    ///< K_tw against twisting about the normal, of spheres (force * length)
  double normal_force;                 ///< static normal force, compression positive (force)
  Vec<Dim> shear_force;                ///< tangential force on i (force)
  RotationVector<Dim> rolling_moment;  ///< rolling moment on i (force * length)
  double twisting_moment = 0.0;        ///< twisting moment on i about the normal (force * length)
  bool distant;                        ///< whether it is an attraction across a gap
  int source;                          ///< index in the contact list from which it was made
  int wall = -1;                       ///< index of the wall that i touches; -1: the contact is between grains

  Vec<Dim> normal() const { return frame.col(0); }
  bool on_wall() const { return wall >= 0; }
};

/// Contacts of a state and the sizes that its linear response uses.
template <int Dim>
struct ContactNetwork {
  int n_grains = 0;
  double volume = 0.0;  ///< volume of the cell; area in 2D
  /// Length that turns a rotation into a displacement: the radius of a round grain.
  std::vector<double> grain_size;
  std::vector<NetworkContact<Dim>> contacts;
  /// Axes between walls, ascending: besides the strains, the two walls of each may move together.
  std::vector<int> wall_axes;

  int n_unknowns() const { return kDofs<Dim> * n_grains; }
};

/// Index of the first unknown of a grain: its translations, then its rotations.
template <int Dim>
constexpr int first_unknown(int grain) {
  return kDofs<Dim> * grain;
}

/// Returns a frame as columns: the unit normal, then unit tangents normal to it and to each other.
Mat<2> contact_frame(const Vec<2>& normal);
Mat<3> contact_frame(const Vec<3>& normal);

/// Returns the network of all contacts of a packing, in their order. Lever arms are l = R r/(R_i + R_j) along
/// the normal (docs/physics.md, "Kinematics of a contact"), so they add up to the branch; the arm to a wall is
/// the distance of its plane.
template <int Dim>
ContactNetwork<Dim> contact_network(const Packing<Dim>& packing);

/// Returns the network without the contacts of some grains. Unknowns keep their numbers.
/// @param removed  one entry per grain: whether to remove its contacts
template <int Dim>
ContactNetwork<Dim> without_grains(const ContactNetwork<Dim>& network, const std::vector<bool>& removed);

/// Returns the largest normal or tangential stiffness in absolute value (force/length), 1 without contacts. K
/// divided by it has a diagonal of order one where rotations are multiplied by the grain's size.
template <int Dim>
double stiffness_scale(const ContactNetwork<Dim>& network);

/// Gives every contact that touches (not distant) the rolling stiffness kr >= 0 (force * length).
template <int Dim>
void set_rolling_stiffness(ContactNetwork<Dim>& network, double kr);

}  // namespace floc
