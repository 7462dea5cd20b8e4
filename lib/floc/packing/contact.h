#pragma once

#include "floc/base/vec.h"
#include "floc/contact/history.h"
#include "floc/geometry/frame.h"

namespace floc {

/// One interaction of a state: two surfaces that touch, as the law defines it, or that attract each other
/// across a gap (a distant attraction). Signs: normal force positive in compression; shear force and rolling
/// moment are those on grain i.
template <int Dim>
struct Contact {
  int i = 0;  ///< index of the first grain
  int j = 0;  ///< index of the second; may equal i (a grain and its own image)
  Vec<Dim, int> image = Vec<Dim, int>::Zero();  ///< branch = x[j] + image * cell.matrix - x[i]
  int key = 0;                                  ///< distinguishes several contacts of one pair and image
  double gap = 0.0;                             ///< distance between the surfaces (length), < 0: overlap
  Vec<Dim> normal = Vec<Dim>::Zero();           ///< unit vector from i to j
  Vec<Dim> arm_i = Vec<Dim>::Zero();            ///< vector from the centre of i to the contact point (length)
  Vec<Dim> arm_j = Vec<Dim>::Zero();        ///< vector from the end of the branch to the contact point (length)
  double normal_force = 0.0;                ///< static: elastic plus adhesive (force)
  double elastic_force = 0.0;               ///< elastic part, >= 0 (force)
  Vec<Dim> shear_force = Vec<Dim>::Zero();  ///< tangential force on i (force)
  /// Moment of the rolling spring on i (force * length).
  RotationVector<Dim> rolling_moment = RotationVector<Dim>::Zero();
  /// For spheres, moment of the twisting spring on i about the normal (force * length).
  double twisting_moment = 0.0;
  double kn = 0.0;              ///< elastic normal stiffness, -F0/D0 for a distant attraction
  double kt = 0.0;              ///< tangential stiffness (force/length)
  double kr = 0.0;              ///< rolling stiffness (force * length)
  double ktw = 0.0;             ///< twisting stiffness (force * length)
  bool sliding = false;         ///< the tangential spring is at its cap
  bool rolling_yield = false;   ///< the rolling spring is at its cap
  bool twisting_yield = false;  ///< the twisting spring is at its cap
  bool distant = false;         ///< the surfaces do not touch, but are in the range of the law
  ContactHistory<Dim> history = ContactHistory<Dim>::Zero();  ///< history, at the places of HistoryLayout

  /// Whether any spring of the contact is at its cap (mobilised).
  bool is_mobilised() const { return sliding || rolling_yield || twisting_yield; }
};

/// Moment of the rolling and the twisting spring on i (force * length), in 3D as a vector in space.
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
