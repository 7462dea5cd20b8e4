#pragma once

#include <span>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Relative motion of the two surfaces of a contact since its history was last updated, in the frame of the
/// normal of the contact.
template <int Dim>
struct SurfaceMotion {
  Shear<Dim> slip = Shear<Dim>::Zero();  ///< tangential displacement of grain j relative to grain i (length)
  /// Rotation of grain i relative to grain j (radians); in 3D only about axes in the tangent plane.
  RotationVector<Dim> relative_rotation = RotationVector<Dim>::Zero();
  double twist = 0.0;  ///< in 3D, rotation of grain i relative to grain j about the normal (radians)
};

/// Turns the history of a contact, and the motion since the history was updated, from the present normal of the
/// contact to a new normal, and sets the normal of the contact to the new normal. The history of a contact
/// whose normal is zero is not turned.
/// @param remembered  quantities of the history (history_quantities())
/// @param normal  the new normal (unit vector)
/// @param twist  mean rotation of the two grains about the normal (radians; ignored in 2D)
template <int Dim>
void transport_history(const std::vector<HistoryQuantity>& remembered, const Vec<Dim>& normal, double twist,
                       Contact<Dim>& contact, SurfaceMotion<Dim>& motion);

/// Updates contacts between the grains of a packing by its contact law: static forces, stiffnesses, flags and
/// the new history of each contact follow from its gap, its normal, its history and its `motion`. The type of
/// the law is resolved once for all contacts.
///
/// @param motion  one entry per contact
template <int Dim>
void respond(const Packing<Dim>& packing, std::span<const SurfaceMotion<Dim>> motion,
             std::span<Contact<Dim>> contacts);

/// Derivatives of the forces of one contact by its motion, with rows and columns in the order of `ContactRows`.
/// Rows: normal force, tangential force on grain i along each tangent, moment on grain i about each axis.
/// Columns: overlap, tangential displacement of grain j relative to grain i along each tangent, rotation of
/// grain j relative to grain i about each axis.
template <int Dim>
using ContactTangent = Eigen::Matrix<double, kDofs<Dim>, kDofs<Dim>>;

/// Computes the consistent tangents of respond(): the derivatives of the forces of the contact law, including
/// the shortening of springs whose forces exceed their caps, in the frame that turns with the contact. A
/// tangent is not symmetric if one force depends on another, for example if a contact slides. A spring whose
/// force is at its cap up to rounding is treated as sliding.
/// @param start  contacts with the present gap and normal, and with the history before the motion
/// @param frame  one frame per contact; its columns are the normal, then the tangents
/// @param tangent  output, one entry per contact
template <int Dim>
void contact_tangents(const Packing<Dim>& packing, std::span<const Contact<Dim>> start,
                      std::span<const SurfaceMotion<Dim>> motion, std::span<const Mat<Dim>> frame,
                      std::span<ContactTangent<Dim>> tangent);

}  // namespace floc
