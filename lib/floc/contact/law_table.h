#pragma once

#include <variant>

#include "floc/contact/contact_law.h"
#include "floc/contact/law_parameters.h"

/// The composed contact laws. To add a model (docs/adding-a-law.md takes you through an example):
///   1. write it as a header in its slot's folder: a struct that declares its numbers and its history
///      (declaration.h) and has the functions of its slot as templates on the number type (see
///      normal/linear_repulsion.h and tangential/coulomb_friction.h);
///   2. add it to its slot in law_parameters.h; the table below is the product of the slots and finds it
///      by itself;
///   3. give the conformance suite a set of sample numbers
///      in tests/support/laws.h, and write a unit test
///      with a closed form.
namespace floc {

/// Which compositions are compiled: of models that go with the normal law (model_traits.h). Grains that slide freely
/// need not roll, and some adhesions leave them free to; a twisting spring goes with a rolling one, which may be one
/// that carries nothing.
template <class Normal, class Adhesion, class Damping, class Tangential, class Rolling, class Twisting>
inline constexpr bool kIsCompiled =
    kGoesWith<Normal, Adhesion>&& kGoesWith<Normal, Damping>&& kGoesWith<Normal, Tangential>&&
        kGoesWith<Normal, Rolling>&& kGoesWith<Normal, Twisting> &&
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

/// All compiled compositions of one model per slot: the models chosen so far, then the slots still to choose
/// from.
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

/// One alternative for each composition that is compiled; it is visited once per run, never per contact.
using AnyContactLaw =
    detail::Compositions<detail::Chosen<>, decltype(LawParameters::normal), decltype(LawParameters::adhesion),
                         decltype(LawParameters::damping), decltype(LawParameters::friction),
                         decltype(LawParameters::rolling), decltype(LawParameters::twisting)>::Type::Variant;

/// A composed law under a name that a header can declare without knowing the models.
struct ComposedLaw {
  AnyContactLaw any;
};

/// The composed law of a scene or saved state. Adhesion of zero force becomes no adhesion; a coefficient of
/// zero becomes no friction, or no resistance to rolling or twisting: such a spring could carry nothing, and
/// must not stiffen the network either.
/// @pre parameters.validate() is empty.
AnyContactLaw compose_law(const LawParameters& parameters);

/// The same law, always with a friction spring: one that can carry nothing where the law has none.
AnyContactLaw compose_with_friction(const LawParameters& parameters);

}  // namespace floc
