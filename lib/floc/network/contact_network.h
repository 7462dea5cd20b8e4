#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Contact in the form that is needed to compute the linear response: contact points on the two bodies, directions,
/// stiffnesses and forces. The grains may have corners.
template <int Dim>
struct NetworkContact {
  int i;  ///< number of the first grain
  /// number of the second grain; equal to i for a contact with an image of grain i itself or with a wall
  int j;
  /// periodic image of j that i touches, given by the number of cells along each lattice vector
  Vec<Dim, int> image;
  /// Vector from the centre of i to the centre of the image of j (length). A strain of the cell changes this vector.
  /// For a contact with a wall, the vector ends on the plane of the wall. Along other axes with walls, the vector ends
  /// at strain_origin(), because a wall moves only along its normal.
  Vec<Dim> branch;
  Vec<Dim> arm_i;  ///< vector from the centre of i to the contact point (length)
  Vec<Dim> arm_j;  ///< vector from the centre of the image of j to the contact point (length)
  Mat<Dim> frame;  ///< columns: the unit normal from i to j, then the tangents
  /// normal stiffness K_N (force/length); for an attraction across a gap -F0/D0 (pull-off force F0, range D0)
  double kn;
  double kt;                           ///< tangential stiffness K_T (force/length)
  double kr;                           ///< rolling stiffness K_R (force * length)
  double ktw = 0.0;                    ///< twisting stiffness K_tw about the normal, in 3D (force * length)
  double normal_force;                 ///< static normal force, compression positive (force)
  Vec<Dim> shear_force;                ///< tangential force on grain i (force)
  RotationVector<Dim> rolling_moment;  ///< rolling moment on grain i (force * length)
  double twisting_moment = 0.0;        ///< twisting moment on grain i about the normal (force * length)
  bool distant;                        ///< whether the contact is an attraction across a gap
  int source;                          ///< index of the contact in Packing::contacts
  int wall = -1;                       ///< index of the wall that i touches; -1 for a contact between grains

  Vec<Dim> normal() const { return frame.col(0); }
  bool on_wall() const { return wall >= 0; }
};

/// Number of components of the motion at a contact of two grains i and j: the displacement of j relative to i, the
/// rotation of i, and the rotation of j.
template <int Dim>
inline constexpr int kMotionRows = Dim + 2 * kRotations<Dim>;

template <int Dim>
using MotionMatrix = Eigen::Matrix<double, kMotionRows<Dim>, kMotionRows<Dim>>;

/// Geometric stiffness of a contact as a set of springs: each spring resists one combination of the components of the
/// motion at the contact (see kMotionRows). Some stiffnesses are negative.
template <int Dim>
struct GeometricSprings {
  MotionMatrix<Dim> directions;  ///< columns: the combinations, which are orthonormal
  /// stiffness of each spring (force/length for displacements; each rotation adds a factor of length)
  Eigen::Matrix<double, kMotionRows<Dim>, 1> stiffness;
};

/// Contact network of a packing: the contacts, and all quantities that determine the linear response of the packing.
template <int Dim>
struct ContactNetwork {
  int n_grains = 0;
  double volume = 0.0;  ///< volume of the cell; area in 2D
  /// Size of each grain (length). The product of size and rotation of a grain is a displacement. The size of a round
  /// grain is its radius.
  std::vector<double> grain_size;
  std::vector<NetworkContact<Dim>> contacts;
  /// Axes whose two walls may move together along the axis, ascending; this motion is an additional unknown of the
  /// boundary. These are the axes with two walls that follow forces or, if no wall of the packing does, all axes with
  /// walls.
  std::vector<int> wall_axes;
  /// Geometric springs of each contact of the packing, in the order of NetworkContact::source. The list is empty unless
  /// the grains have corners and the springs are needed. For round grains, the geometric springs are computed from the
  /// contact itself.
  std::vector<GeometricSprings<Dim>> geometric;

  int n_unknowns() const { return kDofs<Dim> * n_grains; }
};

/// Returns the index of the first unknown of a grain. The translations of the grain come first, then its rotations.
template <int Dim>
constexpr int first_unknown(int grain) {
  return kDofs<Dim> * grain;
}

/// Returns a matrix whose columns are the frame of a contact: the given unit normal, then unit tangents that are
/// orthogonal to the normal and to each other.
Mat<2> contact_frame(const Vec<2>& normal);
Mat<3> contact_frame(const Vec<3>& normal);

/// Returns the network of all contacts of a packing, in the order of Packing::contacts. The contact point of two round
/// grains divides the distance r between their centres in proportion to their radii R_i and R_j: the lever arm of grain
/// i has the length r R_i/(R_i + R_j) and is parallel to the normal (docs/physics.md, "Kinematics of a contact"). The
/// lever arm of a round grain at a wall is the distance of its centre from the plane of the wall.
template <int Dim>
ContactNetwork<Dim> contact_network(const Packing<Dim>& packing);

/// Returns the network without the contacts of some grains. The numbers of the unknowns do not change.
/// @param removed  for each grain, whether its contacts are removed
template <int Dim>
ContactNetwork<Dim> without_grains(const ContactNetwork<Dim>& network, const std::vector<bool>& removed);

/// Returns the largest absolute value among the normal and tangential stiffnesses of all contacts (force/length); 1
/// without contacts. If the stiffness matrix is divided by this value, and rotations are multiplied by the sizes of the
/// grains, the diagonal of the matrix is of order one.
template <int Dim>
double stiffness_scale(const ContactNetwork<Dim>& network);

/// Sets the rolling stiffness of every touching contact to kr >= 0 (force * length). Attractions across a gap are not
/// changed.
template <int Dim>
void set_rolling_stiffness(ContactNetwork<Dim>& network, double kr);

}  // namespace floc
