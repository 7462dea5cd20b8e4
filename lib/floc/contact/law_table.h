#pragma once

#include <variant>

#include "floc/contact/contact_law.h"
#include "floc/contact/law_parameters.h"

/// THE list of contact laws. To add one:
///   1. write its slot as a header in the slot's folder (a struct with templates on the number type, see
///      normal/linear_repulsion.h) and, if it has parameters, its fields in law_parameters.h with their validation;
///   2. add the compositions that make sense to `AnyContactLaw` below, and how keywords choose them to
///      `compose_law()` in law_table.cc;
///   3. write a unit test with a closed form. The conformance suite enumerates this table by itself; all it asks for is
///      one set of sample parameters of a new kind of slot, in tests/support/laws.h.
namespace floc {

namespace laws {
template <class Adhesion, class Damping, class Tangential = NoFriction, class Rolling = NoRolling>
using Linear = ContactLaw<LinearRepulsion, Adhesion, Damping, Tangential, Rolling>;
}  // namespace laws

/// One alternative for each useful composition; it is visited once per run, never per contact.
using AnyContactLaw = std::variant<
    // cohesionless
    laws::Linear<NoAdhesion, NoDamping>,                                       //
    laws::Linear<NoAdhesion, ViscousDamping>,                                  //
    laws::Linear<NoAdhesion, NoDamping, CoulombFriction>,                      //
    laws::Linear<NoAdhesion, ViscousDamping, CoulombFriction>,                 //
    laws::Linear<NoAdhesion, NoDamping, CoulombFriction, RollingSpring>,       //
    laws::Linear<NoAdhesion, ViscousDamping, CoulombFriction, RollingSpring>,  //
    // adhesion with a linear tail
    laws::Linear<TailAdhesion, NoDamping>,                                       //
    laws::Linear<TailAdhesion, ViscousDamping>,                                  //
    laws::Linear<TailAdhesion, NoDamping, CoulombFriction>,                      //
    laws::Linear<TailAdhesion, ViscousDamping, CoulombFriction>,                 //
    laws::Linear<TailAdhesion, NoDamping, CoulombFriction, RollingSpring>,       //
    laws::Linear<TailAdhesion, ViscousDamping, CoulombFriction, RollingSpring>,  //
    // constant adhesion without a tail
    laws::Linear<ConstantAdhesion, NoDamping>,                                      //
    laws::Linear<ConstantAdhesion, ViscousDamping>,                                 //
    laws::Linear<ConstantAdhesion, NoDamping, CoulombFriction>,                     //
    laws::Linear<ConstantAdhesion, ViscousDamping, CoulombFriction>,                //
    laws::Linear<ConstantAdhesion, NoDamping, CoulombFriction, RollingSpring>,      //
    laws::Linear<ConstantAdhesion, ViscousDamping, CoulombFriction, RollingSpring>  //
    >;

/// The composed law of a scene or saved state. Adhesion of zero force is no adhesion, a coefficient of zero no friction and no
/// rolling resistance: such a spring could carry nothing, and must not stiffen the network either.
/// @pre parameters.validate() is empty.
AnyContactLaw compose_law(const LawParameters& parameters);

}  // namespace floc
