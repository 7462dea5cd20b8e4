#pragma once

#include "floc/base/vec.h"

namespace floc {

/// Unilateral contact with Coulomb friction of one pair of bodies within a time step, while the impulses of all other
/// contacts are fixed:
///
///     0 <= P  complementary to  A_n p + q_n >= 0,       p = (P, p_t)
///     A_t p + q_t = 0 where |p_t| < mu P,               otherwise |p_t| = mu P, against A_t p + q_t
///
/// Here p is the impulse on the second body in the frame of the contact (normal, tangents). Its normal component
/// contains only the repulsive part P. A p + q is the relative velocity after the step.
template <int Dim>
struct ContactProblem {
  Mat<Dim> response;      ///< matrix A: relative velocity per impulse, symmetric and positive definite
  Vec<Dim> velocity;      ///< vector q: relative velocity after the step without an impulse of this contact
  double friction = 0.0;  ///< friction coefficient mu >= 0
};

/// Returns the impulse that solves a contact problem. In 2D it is exact. In 3D, where the direction of slip depends on
/// P, the root of the normal velocity as a function of P is found to rounding. With a large mu and a response that
/// couples slip to the normal, several impulses may solve the problem. The impulse that sticks is then preferred, and
/// next the impulse whose slip is opposite to the tangential impulse of sticking.
template <int Dim>
Vec<Dim> contact_impulse(const ContactProblem<Dim>& problem);

/// Returns the error of an impulse as a solution of a contact problem (impulse): the largest component of the natural
/// map of the complementarity problem, p - projection of (p - velocity/A) onto the admissible impulses.
template <int Dim>
double contact_error(const ContactProblem<Dim>& problem, const Vec<Dim>& impulse);

}  // namespace floc
