#pragma once

#include <vector>

#include "floc/rigid/gap_curvature.h"
#include "floc/rigid/step_contact.h"

namespace floc {

/// Solves the contacts of one implicit time step all at once, to the accuracy of rounding, by the interior point
/// method (interior_point.h). Sweeps (gauss_seidel.h) are cheaper for one step, but they need very many where grains move
/// slowly against each other, as frictionless grains with corners do just before they come to rest.
///
/// Without friction the step is a convex program. Coulomb's friction is not of this form: in the program, a contact
/// that slides with u_t also opens with mu |u_t|. This is corrected by adding mu |u_t| of the last solution to the
/// normal velocity and solving again [DF1998].
///
/// @param bodies    as for GaussSeidel; they get the velocities at the end of the step
/// @param contacts  contacts of the step, which get the impulses
/// @param stiffness  for each contact, the change of the momenta of its two bodies by the turn of its normal force, for
/// unit velocities; positive semidefinite, in the order of PairMatrix (mass); empty for none
/// @return whether the program was solved; otherwise nothing is changed. The program fails only by rounding, for
/// instance if time steps are so long that masses hardly count
template <int Dim>
bool solve_at_once(BodyMotion<Dim>& bodies, std::vector<StepContact<Dim>>& contacts,
                   const std::vector<PairMatrix<Dim>>& stiffness);

}  // namespace floc
