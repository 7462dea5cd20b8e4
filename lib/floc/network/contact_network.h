#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Contact in the form that the computation of the linear response uses: its contact points on the two bodies, its
/// directions, stiffnesses and forces. The form does not assume round grains.
template <int Dim>
struct NetworkContact {
  int i;                ///< first grain
  int j;                ///< second grain; equal to i if the grain touches its own image or a wall
  Vec<Dim, int> image;  ///< number of lattice vectors by which the image of j is displaced
  /// Branch vector, which a strain of the boundary stretches: from the centre of i to the centre of the image of j
  /// (length). For a wall, the component along the wall's normal leads to its plane; the other components lead to the
  /// middle of the box along axes that have walls, since a wall moves along its normal only.
  Vec<Dim> branch;
  Vec<Dim> arm_i;        ///< from the centre of i to the contact point (length)
  Vec<Dim> arm_j;        ///< from the centre of the image of j to the contact point (length)
  Mat<Dim> frame;        ///< columns: the unit normal from i to j, then the tangents
  double kn;             ///< normal stiffness K_N; -F0/D0 for an attraction across a gap (force/length)
  double kt;             ///< tangential stiffness K_T (force/length)
  double kr;             ///< rolling stiffness K_R (force * length)
  double ktw = 0.0;      ///< twisting stiffness K_tw about the normal, in 3D (force * length)
  double normal_force;   ///< static normal force, compression positive (force)
  Vec<Dim> shear_force;  ///< tangential force on grain i (force)
  RotationVector<Dim> rolling_moment;  ///< rolling moment on grain i (force * length)
  double twisting_moment = 0.0;        ///< twisting moment on grain i about the normal (force * length)
  bool distant;                        ///< whether the contact is an attraction across a gap
  int source;                          ///< index of the contact in Packing::contacts
  int wall = -1;                       ///< index of the wall that i touches; -1 for a contact between grains

  Vec<Dim> normal() const { return frame.col(0); }
  bool on_wall() const { return wall >= 0; }
};

/// Contact network of a state: its contacts and the quantities that its linear response depends on.
template <int Dim>
struct ContactNetwork {
  int n_grains = 0;
  double volume = 0.0;  ///< volume of the cell; area in 2D
  /// Length of each grain by which its rotation is multiplied to give a displacement: the radius of a round grain.
  std::vector<double> grain_size;
  std::vector<NetworkContact<Dim>> contacts;
  /// Axes that have a wall at both ends, ascending. The two walls of an axis may move together, in addition to the
  /// strains.
  std::vector<int> wall_axes;

  int n_unknowns() const { return kDofs<Dim> * n_grains; }
};

/// Returns the index of the first unknown of a grain. Its translations come first, then its rotations.
template <int Dim>
constexpr int first_unknown(int grain) {
  return kDofs<Dim> * grain;
}

/// Returns the frame of a contact as columns: the unit normal, then unit tangents normal to it and to each other.
Mat<2> contact_frame(const Vec<2>& normal);
Mat<3> contact_frame(const Vec<3>& normal);

/// Returns the network of all contacts of a packing, in the same order. The lever arms are l = R r/(R_i + R_j) along
/// the normal, with the radii R and the branch length r (docs/physics.md, "Kinematics of a contact"), so that they add
/// up to the branch. The arm to a wall is the distance to its plane.
template <int Dim>
ContactNetwork<Dim> contact_network(const Packing<Dim>& packing);

/// Returns the network without the contacts of some grains. The unknowns keep their numbers.
/// @param removed  one entry per grain: whether to remove its contacts
template <int Dim>
ContactNetwork<Dim> without_grains(const ContactNetwork<Dim>& network, const std::vector<bool>& removed);

/// Returns the largest absolute normal or tangential stiffness (force/length); 1 without contacts. The stiffness matrix
/// divided by it has a diagonal of order one if rotations are multiplied by the grain's size.
template <int Dim>
double stiffness_scale(const ContactNetwork<Dim>& network);

/// Sets the rolling stiffness of every touching contact to kr >= 0 (force * length). Attractions across a gap do not
/// change.
template <int Dim>
void set_rolling_stiffness(ContactNetwork<Dim>& network, double kr);

}  // namespace floc
