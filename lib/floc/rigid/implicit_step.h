#pragma once

#include <vector>

#include "floc/rigid/gap_curvature.h"
#include "floc/rigid/step_contact.h"

namespace floc {

/// Solves the contacts of one implicit time step all at once, to the accuracy of rounding, by the interior point method
/// (interior_point.h). For one step, sweeps (gauss_seidel.h) are usually cheaper. However, very many sweeps are needed
/// if grains move slowly against each other, as frictionless grains with corners do just before they come to rest.
///
/// Without friction the step is a convex program. Coulomb's friction does not have this form: in the program, a contact
/// that slides with the velocity u_t also opens with the velocity mu |u_t|, where mu is the friction coefficient. To
/// correct this, mu |u_t| of the last solution is added to the normal velocity, and the program is solved again
/// [DF1998].
///
/// @param bodies    as for GaussSeidel; they get the velocities at the end of the step
/// @param contacts  contacts of the step, which get the impulses
/// @param stiffness  for each contact, the change of the momenta of its two bodies due to the rotation of its normal
/// force, for unit velocities; positive semidefinite, in the order of PairMatrix (mass); empty for none
/// @return whether the program was solved; otherwise nothing is changed. The solution fails only because of rounding
/// errors, for instance if the masses are negligible in a very long time step
template <int Dim>
bool solve_at_once(BodyMotion<Dim>& bodies, std::vector<StepContact<Dim>>& contacts,
                   const std::vector<PairMatrix<Dim>>& stiffness);

}  // namespace floc
