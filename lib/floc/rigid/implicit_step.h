#pragma once

#include <vector>

#include "floc/rigid/gap_curvature.h"
#include "floc/rigid/step_contact.h"

namespace floc {

/// Solves all contacts of one implicit time step at once by the interior point method (interior_point.h), up to
/// rounding errors. Sweeps (gauss_seidel.h) usually take less time. However, very many sweeps are needed if grains move
/// slowly against each other; an example are frictionless grains with corners just before they come to rest.
///
/// Without friction the step is a convex program. Coulomb's friction does not fit into a convex program exactly: in the
/// program, a contact that slides with the velocity u_t also opens with the velocity mu |u_t|, where mu is the friction
/// coefficient. As a correction, an opening velocity s is added to the normal velocity, and the program is solved again
/// [DF1998] until s = mu |u_t| at each contact. After 30 solutions the last one is taken, whose impulses may then
/// violate Coulomb's law.
///
/// @param bodies    motion of the bodies with all external impulses; it gets the velocities at the end of the step
/// @param contacts  contacts of the step; they get the impulses
/// @param stiffness  for each contact, a positive semidefinite matrix (mass). Multiplied by the velocities of the two
/// bodies of the contact, it gives the change of their momenta that is due to the rotation of the normal force. The
/// list may be empty if the rotation of the forces is neglected.
/// @return whether the program was solved; otherwise nothing is changed. Only rounding errors can cause a failure, for
/// example if the masses are negligible in a very long time step
template <int Dim>
bool solve_at_once(BodyMotion<Dim>& bodies, std::vector<StepContact<Dim>>& contacts,
                   const std::vector<PairMatrix<Dim>>& stiffness);

}  // namespace floc
