#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "floc/contact/law_table.h"
#include "support/hysteretic_repulsion.h"
#include "support/sticky_spring.h"

/// Calls tests for all rows of the law table, in every dimension, with sample parameters.
namespace floc::test {

/// Sample parameters of a model in reduced units, similar to the parameters of [GRC2008]. All values are different, so
/// that a test notices if two parameters are exchanged. Each kind of model needs a specialization; without it the tests
/// do not compile.
template <class Slot>
struct Sample;

template <int Tag>
struct Sample<Absent<Tag>> {
  static constexpr Absent<Tag> value{};
  static std::string name() { return ""; }
};
template <>
struct Sample<LinearRepulsion> {
  static constexpr LinearRepulsion value{1e5};
  static std::string name() { return "linear"; }
};
template <>
struct Sample<HertzRepulsion> {
  static constexpr HertzRepulsion value{1.2e6, 0.3};
  static std::string name() { return "hertz"; }
};
template <>
struct Sample<CriticalDamping> {
  static constexpr CriticalDamping value{0.4};
  static std::string name() { return " critical damping"; }
};
template <>
struct Sample<MindlinFriction> {
  static constexpr MindlinFriction value{0.5};
  static std::string name() { return " Mindlin"; }
};
template <>
struct Sample<TailAdhesion> {
  static constexpr TailAdhesion value{1.25, 1e-3};
  static std::string name() { return " tail"; }
};
template <>
struct Sample<ConstantAdhesion> {
  static constexpr ConstantAdhesion value{1.25};
  static std::string name() { return " constant"; }
};
/// The bridges contain so little liquid that they rupture at a gap of a hundredth of a diameter.
template <>
struct Sample<CapillaryAdhesion> {
  static constexpr CapillaryAdhesion value{0.4, 20.0, 4e-7, 2.5};
  static std::string name() { return " capillary"; }
};
template <>
struct Sample<ViscousDamping> {
  static constexpr ViscousDamping value{0.3, DampingMass::effective};
  static std::string name() { return " damping"; }
};
template <>
struct Sample<CoulombFriction> {
  static constexpr CoulombFriction value{0.5, 0.8e5};
  static std::string name() { return " friction"; }
};
template <>
struct Sample<RollingSpring> {
  static constexpr RollingSpring value{0.05, 30.0};
  static std::string name() { return " rolling"; }
};

template <>
struct Sample<TwistingSpring> {
  static constexpr TwistingSpring value{0.04, 20.0};
  static std::string name() { return " twisting"; }
};

template <>
struct Sample<HystereticRepulsion> {
  static constexpr HystereticRepulsion value{1e5, 2.5e5};
  static std::string name() { return "hysteretic"; }
};
template <>
struct Sample<StickySpring> {
  static constexpr StickySpring value{1e5, 2e-5};
  static std::string name() { return "sticky"; }
};

template <class... Models>
constexpr auto sample_law(std::type_identity<ContactLaw<Models...>>) {
  return ContactLaw<Models...>{Sample<Models>::value...};
}

template <class... Models>
std::string law_name(std::type_identity<ContactLaw<Models...>>) {
  return (Sample<Models>::name() + ...);
}

template <class Laws>
struct ListOfLaws;
template <class... Laws>
struct ListOfLaws<std::variant<Laws...>> {
  template <class Check>
  static void visit(Check&& check) {
    const auto one = [&]<class Law>(std::type_identity<Law> row) {
      SCOPED_TRACE(law_name(row));
      check(sample_law(row));
    };
    (one(std::type_identity<Laws>{}), ...);
  }
};

/// Calls check(law) for every row of the law table. The message of a failure names the row.
template <class Check>
void for_each_law(Check&& check) {
  ListOfLaws<AnyContactLaw>::visit(check);
}

/// Kinds of laws that the table does not contain yet: laws that dissipate energy in the normal direction, laws whose
/// surfaces separate while the grains still overlap, and laws whose surfaces stay connected across a gap.
using LawsOfOtherKinds = std::variant<
    ContactLaw<HystereticRepulsion, NoAdhesion, NoDamping, NoFriction, NoRolling, NoTwisting>,
    ContactLaw<HystereticRepulsion, TailAdhesion, ViscousDamping, CoulombFriction, RollingSpring,
               TwistingSpring>,
    ContactLaw<StickySpring, NoAdhesion, NoDamping, NoFriction, NoRolling, NoTwisting>,
    ContactLaw<StickySpring, NoAdhesion, ViscousDamping, CoulombFriction, RollingSpring, TwistingSpring>>;

/// Calls check(law) for every row of the law table and for every law of LawsOfOtherKinds, as for_each_law() does for
/// the rows.
template <class Check>
void for_each_kind_of_law(Check&& check) {
  for_each_law(check);
  ListOfLaws<LawsOfOtherKinds>::visit(check);
}

template <class Law, class Check>
void in_each_dimension(const Law& law, Check& check) {
  if constexpr (Law::kDimension != 3) {
    SCOPED_TRACE("in 2D");
    check(law, std::integral_constant<int, 2>{});
  }
  SCOPED_TRACE("in 3D");
  check(law, std::integral_constant<int, 3>{});
}

/// Calls check(law, dimension) for every law of for_each_kind_of_law() in each of its dimensions;
/// `decltype(dimension)::value` is the dimension.
template <class Check>
void for_each_kind_of_law_and_dimension(Check&& check) {
  for_each_kind_of_law([&](const auto& law) { in_each_dimension(law, check); });
}
template <class Check>
void for_each_law_and_dimension(Check&& check) {
  for_each_law([&](const auto& law) { in_each_dimension(law, check); });
}

/// Type of the history of a contact under a law.
template <class Law, int Dim, class T = double>
using ContactHistoryOf = PackedHistory<std::decay_t<Law>::template kHistorySize<Dim>, T>;

template <class T = double>
PairGeometry<T> pair_at(const T& gap) {
  return {gap, T(0.1875), T(1.0 / 3.0)};  // radii 0.5 and 0.3, masses 1 and 0.5
}

/// Returns the pull-off force F0 of a law. The result is 0 without adhesion. It is also 0 for laws with liquid, because
/// the contacts have no bridge yet.
template <class Law>
double pull_off_force(const Law& law) {
  if constexpr (kAdheresByItself<typename Law::NormalModel>)
    return law.repulsion.pull_off_force(pair_at(0.0));
  else if constexpr (requires { law.adhesion.pull_off_force; })
    return law.adhesion.pull_off_force;
  return 0.0;
}

/// Whether the grains of a new contact attract each other. Under a law with liquid they do not, because a new contact
/// has no bridge yet.
template <class Law>
inline constexpr bool kAdheres = Law::kHasAdhesion && !Law::kHoldsLiquid;

/// Returns the parameters with which a scene gives this law. This function is the inverse of compose_law().
template <class Law>
LawParameters parameters_of(const Law& law) {
  LawParameters p;
  p.normal = law.repulsion;
  p.adhesion = law.adhesion;
  p.damping = law.damping;
  p.friction = law.friction;
  p.rolling = law.rolling;
  p.twisting = law.twisting;
  return p;
}

/// Returns the elastic normal force of a new contact.
template <class Law>
double elastic_force_at(const Law& law, double gap) {
  return law.normal(pair_at(gap)).elastic;
}

/// Returns the largest normal stiffness K_N of a contact for overlaps up to 1e-2.
template <class Law>
double stiffness_bound(const Law& law) {
  return law.stiffness_bound(pair_at(0.0), {1e-2}).normal;
}

/// Returns the overlap of a pair on which no external force acts: adhesion and repulsion balance. Zero without
/// adhesion. The overlap is computed by Newton's method. The first step uses the largest stiffness, which is exact for
/// linear repulsion.
template <class Law>
double free_overlap(const Law& law) {
  if (pull_off_force(law) == 0.0) return 0.0;
  double h = pull_off_force(law) / stiffness_bound(law);
  for (int k = 0; k < 50; ++k) {
    const auto response = law.normal(pair_at(-h));
    if (h == 0.0 || std::abs(response.force()) <= 4e-16 * pull_off_force(law)) break;
    h -= response.force() / response.stiffness;
  }
  return h;
}

/// Whether the normal force is independent of earlier overlaps, as for elastic repulsion.
template <class Law>
inline constexpr bool kForgetsOverlap = history_size<typename std::decay_t<Law>::NormalModel>(2) == 0;

/// Returns the history of a contact that was pressed to an overlap larger than in any test. For laws that do not depend
/// on earlier overlaps, returns the history of a new contact.
template <int Dim, class T = double, class Law>
ContactHistoryOf<Law, Dim, T> pressed_memory(const Law& law) {
  ContactHistoryOf<Law, Dim, T> history;
  if constexpr (!kForgetsOverlap<Law>) {
    ContactMotion<Dim, T> motion{pair_at(T(-4e-4)), T(0), T(0), Shear<Dim, T>::Zero(),
                                 RotationVector<Dim, T>::Zero()};
    law.respond(motion, history);
  }
  return history;
}
/// Returns the static normal response of a contact with the history of pressed_memory(). pressed_energy() returns the
/// energy of this contact.
template <class T, class Law>
NormalResponse<T> pressed_response(const Law& law, const T& gap) {
  const auto history = pressed_memory<2, T>(law);
  if constexpr (kForgetsOverlap<Law>)
    return law.normal(pair_at(gap));
  else
    return law.normal(pair_at(gap), history.value);
}
template <class T, class Law>
T pressed_energy(const Law& law, const T& gap) {
  const auto history = pressed_memory<2, T>(law);
  if constexpr (kForgetsOverlap<Law>)
    return law.energy(pair_at(gap));
  else
    return law.energy(pair_at(gap), history.value);
}
/// Returns the stiffness that a contact with the history of pressed_memory() has in the contact network.
template <class Law>
ContactStiffness pressed_stiffness(const Law& law, double gap) {
  return law.template stiffness<2>(pair_at(gap), pressed_memory<2>(law));
}

/// Returns the stiffness of a new contact.
template <int Dim = 2, class Law>
ContactStiffness stiffness_at(const Law& law, double gap) {
  return law.template stiffness<Dim>(pair_at(gap), ContactHistoryOf<Law, Dim>{});
}

/// Returns a contact motion at a fixed gap, without slip and rotation.
template <int Dim, class T = double>
ContactMotion<Dim, T> at_gap(const T& gap) {
  return {pair_at(gap), T(0), T(0), Shear<Dim, T>::Zero(), RotationVector<Dim, T>::Zero()};
}

/// Returns a tangential displacement of a contact. In 3D, the normal of the contact must be the last axis.
template <int Dim>
Shear<Dim> slip_by(double length) {
  Shear<Dim> slip = Shear<Dim>::Zero();
  slip[0] = length;
  return slip;
}

}  // namespace floc::test
