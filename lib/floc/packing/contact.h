#pragma once

#include "floc/base/vec.h"
#include "floc/contact/history.h"
#include "floc/geometry/frame.h"
#include "floc/shape/manifold.h"

namespace floc {

/// One interaction in a packing. Either two surfaces touch (by the criterion of the contact law), or they attract each
/// other across a gap (a distant attraction). The normal force is positive in compression. The shear force and the
/// rolling moment act on grain i.
template <int Dim>
struct Contact {
  int i = 0;  ///< index of the first grain
  int j = 0;  ///< index of the second grain or of a wall; equal to i if a grain touches its own image
  /// Periodic image of j that interacts with i: the branch vector from i to j is x[j] + image * cell.matrix - x[i].
  Vec<Dim, int> image = Vec<Dim, int>::Zero();
  /// Number that distinguishes several contacts between i and one image of j.
  int key = 0;
  double gap = 0.0;                    ///< distance between the surfaces (length), negative if they overlap
  Vec<Dim> normal = Vec<Dim>::Zero();  ///< unit vector from i to j
  Vec<Dim> arm_i = Vec<Dim>::Zero();   ///< vector from the centre of i to the contact point (length)
  /// Vector from the centre of j to the contact point (length). If j is a wall, the vector begins at the point of the
  /// wall that is nearest to the centre of i.
  Vec<Dim> arm_j = Vec<Dim>::Zero();
  double normal_force = 0.0;                ///< static normal force: elastic part plus adhesive part (force)
  double elastic_force = 0.0;               ///< elastic part of the normal force, >= 0 (force)
  Vec<Dim> shear_force = Vec<Dim>::Zero();  ///< tangential force on grain i (force)
  /// Moment of the rolling spring on grain i (force * length).
  RotationVector<Dim> rolling_moment = RotationVector<Dim>::Zero();
  /// For spheres, moment of the twisting spring on grain i about the normal (force * length).
  double twisting_moment = 0.0;
  /// Elastic normal stiffness (force/length). For a distant attraction it is -F0/D0, with the pull-off force F0
  /// and the range D0 of the attraction.
  double kn = 0.0;
  double kt = 0.0;              ///< tangential stiffness (force/length)
  double kr = 0.0;              ///< rolling stiffness (force * length)
  double ktw = 0.0;             ///< twisting stiffness (force * length)
  bool sliding = false;         ///< whether the tangential force has reached its cap
  bool rolling_yield = false;   ///< whether the rolling moment has reached its cap
  bool twisting_yield = false;  ///< whether the twisting moment has reached its cap
  /// For grains with corners, the kind of features that meet at the contact: a vertex and a face, two edges, ...;
  /// kVertexFace for round grains.
  ContactType type = ContactType::kVertexFace;
  bool distant = false;  ///< whether the surfaces attract each other across a gap, without touching
  /// Whether the contact is a bond: it acts at any gap, and its forces and stiffnesses are given data that do not
  /// follow from the contact law.
  bool bonded = false;
  /// History of the contact, as defined by the contact law; HistoryLayout gives the order of the numbers.
  ContactHistory<Dim> history = ContactHistory<Dim>::Zero();

  /// Whether the contact is mobilised: at least one of its springs has a force or moment at the cap.
  bool is_mobilised() const { return sliding || rolling_yield || twisting_yield; }
};

/// Returns the total moment of the rolling and twisting springs on grain i (force * length), in 3D as a vector in
/// space.
template <int Dim>
RotationVector<Dim> spring_moment(const RotationVector<Dim>& rolling, double twisting, const Vec<Dim>& normal) {
  if constexpr (Dim == 3)
    return rolling + twisting * normal;
  else
    return rolling;
}
template <int Dim>
RotationVector<Dim> spring_moment(const Contact<Dim>& c) {
  return spring_moment<Dim>(c.rolling_moment, c.twisting_moment, c.normal);
}

}  // namespace floc
