#pragma once

#include <variant>

#include "floc/contact/contact_law.h"
#include "floc/contact/law_parameters.h"

/// Composed contact laws. A model is added in three steps (docs/adding-a-law.md has an example):
///   1. write the model as a header in the folder of its slot: a struct that declares its numbers and its history
///      (declaration.h) and has the functions of its slot as templates on the number type (see
///      normal/linear_repulsion.h and tangential/coulomb_friction.h);
///   2. add the model to its slot in law_parameters.h; the table below then combines it with the models of the other
///      slots;
///   3. add a set of sample numbers for the conformance tests to tests/support/laws.h, and write a unit test
///      with a closed form.
namespace floc {

/// Whether the program contains the contact law composed of these models. Three conditions must hold: each model can be
/// combined with the normal law (kGoesWith, model_traits.h); a law with rolling resistance has friction and no liquid
/// bridges (kRollsFreely); a law with twisting resistance has a rolling spring, whose coefficient may be zero. Rigid
/// contacts are never composed, because their forces are not functions of the geometry.
template <class Normal, class Adhesion, class Damping, class Tangential, class Rolling, class Twisting>
inline constexpr bool kIsCompiled =
    family_of<Normal>() != Family::rigid&& kGoesWith<Normal, Adhesion>&& kGoesWith<Normal, Damping>&& kGoesWith<
                               Normal, Tangential>&& kGoesWith<Normal, Rolling>&& kGoesWith<Normal, Twisting> &&
    (kIsAbsent<Twisting> || !kIsAbsent<Rolling>)&&(kIsAbsent<Rolling> ||
                                                   (!kIsAbsent<Tangential> && !kRollsFreely<Adhesion>));

namespace detail {

template <class... Laws>
struct LawList {
  using Variant = std::variant<Laws...>;
};

template <class... Lists>
struct Joined;
template <class... Laws>
struct Joined<LawList<Laws...>> {
  using Type = LawList<Laws...>;
};
template <class... A, class... B, class... Rest>
struct Joined<LawList<A...>, LawList<B...>, Rest...> : Joined<LawList<A..., B...>, Rest...> {};

/// List of all compiled contact laws that contain the given models `Models` and one model of each slot in `Slots`
/// (normal, adhesion, ...). The recursion chooses the model of one slot after the other.
template <class Models, class... Slots>
struct Compositions;
template <class... M>
struct Chosen {};

template <class... M>
struct Compositions<Chosen<M...>> {
  using Type = std::conditional_t<kIsCompiled<M...>, LawList<ContactLaw<M...>>, LawList<>>;
};
template <class... M, class... Models, class... Rest>
struct Compositions<Chosen<M...>, LawSlot<Models...>, Rest...> {
  using Type = typename Joined<LawList<>, typename Compositions<Chosen<M..., Models>, Rest...>::Type...>::Type;
};

}  // namespace detail

/// Any of the compiled contact laws. For speed, the variant is visited once for many contacts, not once per contact.
using AnyContactLaw =
    detail::Compositions<detail::Chosen<>, decltype(LawParameters::normal), decltype(LawParameters::adhesion),
                         decltype(LawParameters::damping), decltype(LawParameters::friction),
                         decltype(LawParameters::rolling), decltype(LawParameters::twisting)>::Type::Variant;

/// Struct that holds a composed contact law. Headers can declare it without including the models.
struct ComposedLaw {
  AnyContactLaw any;
};

/// Composes the contact law of a scene file or a saved state. Models without effect are left out: adhesion of zero
/// force, and friction, rolling or twisting resistance with a coefficient of zero. Their forces are always zero, and
/// their stiffnesses must not be part of the elastic network of contacts.
/// @pre parameters.validate() is empty.
/// @throws InputError if the contacts are rigid
AnyContactLaw compose_law(const LawParameters& parameters);

/// Composes a contact law as compose_law() does, but always with a friction spring. For a law without friction, the
/// friction coefficient of this spring is zero, and so is its force.
AnyContactLaw compose_with_friction(const LawParameters& parameters);

}  // namespace floc
