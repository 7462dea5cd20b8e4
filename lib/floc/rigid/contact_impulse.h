#pragma once

#include "floc/base/vec.h"

namespace floc {

/// Unilateral contact with Coulomb friction between two bodies within a time step. The impulses of all other contacts
/// are fixed. The conditions for the impulse p are
///
///     0 <= P  complementary to  A_n p + q_n >= 0,       p = (P, p_t)
///     A_t p + q_t = 0 if |p_t| < mu P,                  otherwise |p_t| = mu P, and p_t is opposite to A_t p + q_t
///
/// Here p is the impulse on the second body in the frame of the contact (normal, tangents). The normal component P is
/// only the repulsive part of the normal impulse. A p + q is the relative velocity after the step; the indices n and t
/// denote its normal and tangential components, and A_tt is the tangential block of A.
template <int Dim>
struct ContactProblem {
  Mat<Dim> response;      ///< symmetric positive definite matrix A: relative velocity for a unit impulse
  Vec<Dim> velocity;      ///< vector q: relative velocity after the step without an impulse of this contact
  double friction = 0.0;  ///< friction coefficient mu >= 0
};

/// Returns the impulse that solves a contact problem. In 2D a closed formula gives the impulse. In 3D the direction of
/// slip depends on P. An iteration finds, up to rounding errors, the P at which the normal velocity is zero. If mu is
/// large and the response couples slip to the normal velocity, several impulses may solve the problem. In this case the
/// function returns an impulse with which the contact sticks, if there is such an impulse. Otherwise the function
/// returns an impulse with a slip opposite to the tangential impulse that sticking would need.
template <int Dim>
Vec<Dim> contact_impulse(const ContactProblem<Dim>& problem);

/// Returns the error of an impulse as a solution of a contact problem (unit of impulse). Let P and p_t be the normal
/// and the tangential part of the impulse, u_n and u_t those of the relative velocity after the step, and A the matrix
/// of the problem. The error is the larger of |P - [P - u_n/A_nn]_+| and |p_t - proj(p_t - u_t/a)|. Here [x]_+ = max(x,
/// 0), proj is the projection onto the vectors with |p_t| <= mu P, and a is the mean of the diagonal of A_tt.
template <int Dim>
double contact_error(const ContactProblem<Dim>& problem, const Vec<Dim>& impulse);

}  // namespace floc
