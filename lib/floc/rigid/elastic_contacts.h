#pragma once

#include "floc/packing/packing.h"
#include "floc/rigid/step_contact.h"

namespace floc {

/// Gives a contact of an implicit time step the springs of its contact law. With the stiffnesses K_N and K_T, the time
/// step dt, the gap g at the start of the step and the elongation s of the tangential spring, the compliances are
/// C_n = 1/(K_N dt^2) and C_t = 1/(K_T dt^2), and the bias grows by (g/dt, s/dt). The impulses of the step are then
/// those of the forces K_N times the overlap and K_T times the elongation at the end of the step.
/// @param contact  contact with its present gap and tangential force
/// @pre the law has linear normal springs, and linear tangential springs or no friction
template <int Dim>
void add_springs(const Packing<Dim>& packing, const Contact<Dim>& contact, double dt, StepContact<Dim>& step);

/// Gives the contacts of a packing the forces of their contact law: the normal forces that follow from the gaps, and
/// the present tangential forces, reduced to Coulomb's limit if they exceed it. The springs of the contacts are set to
/// give these forces. Contacts with a gap get no force.
/// @pre as for add_springs()
template <int Dim>
void set_spring_forces(Packing<Dim>& packing);

}  // namespace floc
