#pragma once

#include <span>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Relative motion of the two surfaces in a contact, since the last update of the history of the contact. The
/// components refer to the frame of the contact normal.
template <int Dim>
struct SurfaceMotion {
  Shear<Dim> slip = Shear<Dim>::Zero();  ///< tangential displacement of grain j relative to grain i (length)
  /// Rotation of grain i relative to grain j (radians). In 3D it contains only the rotation about axes in the tangent
  /// plane.
  RotationVector<Dim> relative_rotation = RotationVector<Dim>::Zero();
  double twist = 0.0;  ///< in 3D, rotation of grain i relative to grain j about the normal (radians)
};

/// Replaces the normal of a contact by `normal`. Two quantities are rotated with the normal: the history of the
/// contact, and the motion of the surfaces since the last update of the history. If the old normal is zero, nothing is
/// rotated.
/// @param remembered  quantities in the history of the contact, from history_quantities()
/// @param normal  the new normal (unit vector)
/// @param twist  mean rotation of the two grains about the normal (radians; ignored in 2D)
template <int Dim>
void transport_history(const std::vector<HistoryQuantity>& remembered, const Vec<Dim>& normal, double twist,
                       Contact<Dim>& contact, SurfaceMotion<Dim>& motion);

/// Updates contacts by the contact laws of a packing. The static forces, stiffnesses, flags and new
/// history of each contact follow from its gap, its normal, its old history and the motion of its surfaces.
///
/// @param motion  motion of the surfaces of each contact, in the order of `contacts`
template <int Dim>
void respond(const Packing<Dim>& packing, std::span<const SurfaceMotion<Dim>> motion,
             std::span<Contact<Dim>> contacts);

/// Derivatives of the forces of one contact with respect to the relative motion of its surfaces. The rows are the
/// normal force, the tangential force on grain i along each tangent, and the moment on grain i about each axis. The
/// columns are the overlap, the tangential displacement of grain j relative to grain i along each tangent, and the
/// rotation of grain j relative to grain i about each axis. Rows and columns are in the order of `ContactRows`.
template <int Dim>
using ContactTangent = Eigen::Matrix<double, kDofs<Dim>, kDofs<Dim>>;

/// Computes the consistent tangent matrix of respond() for each contact: the derivatives of the forces of the contact
/// law, in the frame that rotates with the contact. The derivatives include the shortening of springs whose forces
/// exceed their caps; a spring whose force equals its cap up to rounding errors is treated as sliding. The matrix is
/// not symmetric if one force depends on another, for example if the contact slides.
/// @param start  contacts with the present gap and normal, and with the history before the motion
/// @param frame  frame of each contact: a matrix whose columns are the normal, then the tangents
/// @param tangent  output: tangent matrix of each contact
template <int Dim>
void contact_tangents(const Packing<Dim>& packing, std::span<const Contact<Dim>> start,
                      std::span<const SurfaceMotion<Dim>> motion, std::span<const Mat<Dim>> frame,
                      std::span<ContactTangent<Dim>> tangent);

}  // namespace floc
