#pragma once

#include "floc/base/vec.h"

namespace floc {

/// Unilateral contact with Coulomb friction of one pair of bodies within a time step, while the impulses of all other
/// contacts are fixed:
///
///     0 <= P  complementary to  A_n p + q_n >= 0,       p = (P, p_t)
///     A_t p + q_t = 0 where |p_t| < mu P,               otherwise |p_t| = mu P, against A_t p + q_t
///
/// Here p is the impulse on the second body in the frame of the contact (normal, tangents). The normal component P is
/// only the repulsive part of the normal impulse. A p + q is the relative velocity after the step.
template <int Dim>
struct ContactProblem {
  Mat<Dim> response;      ///< symmetric positive definite matrix A: relative velocity for a unit impulse
  Vec<Dim> velocity;      ///< vector q: relative velocity after the step without an impulse of this contact
  double friction = 0.0;  ///< friction coefficient mu >= 0
};

/// Returns the impulse that solves a contact problem. In 2D a closed formula gives the impulse. In 3D the direction of
/// slip depends on P; an iteration finds the P at which the normal velocity is zero, exactly up to rounding. If mu is
/// large and the response couples slip to the normal velocity, several impulses may solve the problem. An impulse that
/// sticks is then preferred, and otherwise an impulse whose slip is opposite to the tangential impulse that would be
/// needed for sticking.
template <int Dim>
Vec<Dim> contact_impulse(const ContactProblem<Dim>& problem);

/// Returns the error of an impulse p as a solution of a contact problem (impulse): the largest component of the natural
/// map of the complementarity problem, that is, of p minus the projection of p - (velocity)/A onto the admissible
/// impulses.
template <int Dim>
double contact_error(const ContactProblem<Dim>& problem, const Vec<Dim>& impulse);

}  // namespace floc
