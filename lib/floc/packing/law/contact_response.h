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

/// Carries what a contact remembers, and its motion since, from its normal to another, which it then has. A
/// contact without a normal (zero) takes the new one and keeps its history as it is.
///
/// @param remembered  what the law remembers (history_quantities)
/// @param twist  rotation about the normal, mean of the two grains (radians; ignored in 2D)
template <int Dim>
void transport_history(const std::vector<HistoryQuantity>& remembered, const Vec<Dim>& normal, double twist,
                       Contact<Dim>& contact, SurfaceMotion<Dim>& motion);

/// Static response of contacts between the grains of a packing, by its law: forces, stiffnesses, flags and the
/// new history of each follow from its `gap`, its `normal` and its history, which moves by `motion`. The law is
/// resolved once for all of them.
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

/// The consistent tangents of `respond`: derivatives of the law's own response, including the return to its
/// caps, in the frame that turns with the contact. Not symmetric where one force depends on another, as when it
/// slides. A contact that is at its cap to rounding is taken to go on sliding.
///
/// @param start    contacts before the motion: `gap` and `normal` of the present, history at the start
/// @param frame    of each: columns the normal, then the tangents
/// @param tangent  written, one entry per contact
template <int Dim>
void contact_tangents(const Packing<Dim>& packing, std::span<const Contact<Dim>> start,
                      std::span<const SurfaceMotion<Dim>> motion, std::span<const Mat<Dim>> frame,
                      std::span<ContactTangent<Dim>> tangent);

}  // namespace floc
