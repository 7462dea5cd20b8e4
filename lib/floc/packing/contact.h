#pragma once

#include "floc/base/vec.h"
#include "floc/contact/history.h"
#include "floc/geometry/frame.h"

namespace floc {

/// One interaction of an equilibrated state: two surfaces that touch, as the law sees it, or are in its range: a distant
/// attraction across a gap.
/// Signs: normal force positive in compression; shear force and rolling moment are those on grain i.
template <int Dim>
struct Contact {
  int i = 0;  ///< index of the first grain
  int j = 0;  ///< index of the second; may equal i (a grain and its own image)
  Vec<Dim, int> image = Vec<Dim, int>::Zero();  ///< branch = x[j] + image * cell.matrix - x[i]
  int key = 0;                                  ///< tells several contacts of one pair and image apart
  double gap = 0.0;                             ///< distance between the surfaces (length), < 0: overlap
  Vec<Dim> normal = Vec<Dim>::Zero();           ///< unit vector from i to j
  Vec<Dim> arm_i = Vec<Dim>::Zero();            ///< from the centre of i to the contact point (length)
  Vec<Dim> arm_j = Vec<Dim>::Zero();            ///< from the end of the branch to the contact point (length)
  double normal_force = 0.0;                    ///< static: elastic plus adhesive (force)
  double elastic_force = 0.0;                   ///< elastic part, >= 0 (force)
  Vec<Dim> shear_force = Vec<Dim>::Zero();      ///< tangential force on i (force)
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
  bool distant = false;         ///< in range of the law, but the surfaces do not touch
  ContactHistory<Dim> history = ContactHistory<Dim>::Zero();  ///< history, at the places of the layout

  /// Whether any of its springs is at its cap.
  bool yields() const { return sliding || rolling_yield || twisting_yield; }
};

/// Moment of rolling and twisting springs on i, in 3D a vector in space.
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
