#pragma once

#include <span>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Relative motion of the two surfaces of a contact since its history was last updated, in the frame of its
/// normal.
template <int Dim>
struct SurfaceMotion {
  Shear<Dim> slip = Shear<Dim>::Zero();  ///< tangential displacement of j against i (length)
  /// Rotation of i against j, in 3D only about axes in the tangent plane (radians).
  RotationVector<Dim> relative_rotation = RotationVector<Dim>::Zero();
  double twist = 0.0;  ///< in 3D, rotation of i against j about the normal (radians)
};

/// Turns the history of a contact, and the motion since it was updated, from the contact's normal to a new
/// normal, and sets the contact's normal to it. The history of a contact whose normal is zero is not turned.
/// @param remembered  quantities of the history (history_quantities())
/// @param normal  the new normal (unit vector)
/// @param twist  rotation about the normal, mean of the two grains (radians; ignored in 2D)
template <int Dim>
void transport_history(const std::vector<HistoryQuantity>& remembered, const Vec<Dim>& normal, double twist,
                       Contact<Dim>& contact, SurfaceMotion<Dim>& motion);

/// Updates contacts between the grains of a packing by its law: static forces, stiffnesses, flags and the new
/// history of each contact follow from its `gap`, its `normal`, its history and its `motion`. The type of the
/// law is resolved once for all contacts.
///
/// @param motion   one entry per contact
template <int Dim>
void respond(const Packing<Dim>& packing, std::span<const SurfaceMotion<Dim>> motion,
             std::span<Contact<Dim>> contacts);

/// Derivatives of the forces of one contact, rows and columns in the order of `ContactRows`: normal force,
/// tangential force on i along each tangent, moment on i about each axis, by overlap, tangential displacement
/// of j against i along each tangent, rotation of j against i about each axis.
template <int Dim>
using ContactTangent = Eigen::Matrix<double, kDofs<Dim>, kDofs<Dim>>;

/// Computes the consistent tangents of respond(): derivatives of the law's response, including the return to
/// its caps, in the frame that turns with the contact. A tangent is not symmetric where one force depends on
/// another, as where a contact slides. A spring that is at its cap up to rounding is treated as sliding.
/// @param start  contacts with the present `gap` and `normal`, and the history before the motion
/// @param frame  one per contact: its columns are the normal, then the tangents
/// @param tangent  written, one entry per contact
template <int Dim>
void contact_tangents(const Packing<Dim>& packing, std::span<const Contact<Dim>> start,
                      std::span<const SurfaceMotion<Dim>> motion, std::span<const Mat<Dim>> frame,
                      std::span<ContactTangent<Dim>> tangent);

}  // namespace floc
