#pragma once

#include <type_traits>
#include <utility>
#include <variant>

#include "floc/base/lanes.h"
#include "floc/contact/law_table.h"
#include "floc/contact/neutral.h"
#include "floc/relaxation/partner.h"

/// The pair kernels that there are. A kernel takes long to compile, so there is not one for each composition of the
/// law table: a law is completed to a *kernel law* by models that can do nothing, and the kernel of that law gives
/// it the bits that a kernel of its own would. KernelLawOf decides:
///   - Kernels have damping. A law without it has coefficients of zero, and its dashpot forces are not kept.
///   - Constant adhesion and adhesion with a tail are one model, DryAttraction, which also stands for none.
///   - Where an attraction of zero takes up to a tenth of the pass, between grains without adhesion, kernels without
///     it remain; and where a dashpot takes half of it, without friction as well, kernels without damping.
///   - Grains have kernels without friction, with it, and with rolling and twisting.
///   - Walls are dry, and their kernels have damping and DryAttraction.
/// All of this is for normal laws that have special kernels (kHasSpecialKernels). Any other has general kernels
/// alone: everything is in them that can be there beside this normal law, and they serve lattices of any shape.
/// So a new normal law adds the fewest kernels; where its speed matters, give it special ones.
/// History that the kernel law has and the law of the scene has not is kept for no pair (PairKernel).
namespace floc {

/// Whether a normal law has kernels for less than everything, which are faster, and such for rectangular lattices.
template <class Normal>
inline constexpr bool kHasSpecialKernels = false;
template <>
inline constexpr bool kHasSpecialKernels<LinearRepulsion> = true;
template <>
inline constexpr bool kHasSpecialKernels<HertzRepulsion> = true;

/// Adhesion that depends on the gap alone, or none: -F0 in contact and, with a tail, from there linearly to zero.
struct DryAttraction {
  double in_contact = 0.0;  ///< F0 (force)
  double slope = 0.0;       ///< F0/D0 (force/length), 0 without a tail
  double at_touch = 0.0;    ///< F0 with a tail, else 0 (force)

  DryAttraction() = default;
  explicit DryAttraction(const NoAdhesion&) {}
  explicit DryAttraction(const ConstantAdhesion& law) : in_contact(law.pull_off_force) {}
  explicit DryAttraction(const TailAdhesion& law)
      : in_contact(law.pull_off_force),
        slope(law.pull_off_force / law.tail_range),
        at_touch(law.pull_off_force) {}

  template <class T>
  T force(const PairGeometry<T>& pair) const {
    const T tail = lanes::min(T(0), T(slope * pair.gap - at_touch));
    return lanes::select(pair.gap < T(0), T(-in_contact), tail);
  }
  /// Damping in contact is all that reads it.
  template <class T>
  T stiffness(const PairGeometry<T>&) const {
    return T(0);
  }
};

namespace detail {

/// Model, or Neutral where there is none.
template <class Model, class Neutral>
using Present = std::conditional_t<kIsAbsent<Model>, Neutral, Model>;

template <class Law, int Dim, Partner partner>
struct KernelLawOf;
template <class Normal, class Adhesion, class Damping, class Friction, class Rolling, class Twisting, int Dim,
          Partner partner>
struct KernelLawOf<ContactLaw<Normal, Adhesion, Damping, Friction, Rolling, Twisting>, Dim, partner> {
  static constexpr bool kElasticSpheres = family_of<Normal>() == Family::elastic_spheres;
  static constexpr bool kWet = kHoldsLiquid<Adhesion> && partner == Partner::grain;
  static constexpr bool kNoAttraction = kIsAbsent<Adhesion> && partner == Partner::grain;
  static constexpr bool kNoDashpot =
      kIsAbsent<Adhesion> && kIsAbsent<Friction> && kIsAbsent<Damping> && partner == Partner::grain;
  static constexpr bool kIsDryAttraction =
      kHoldsLiquid<Adhesion> || std::is_constructible_v<DryAttraction, Adhesion>;
  // Which models go together is told by kIsCompiled: elastic spheres adhere by liquid alone; neither they nor grains
  // with liquid resist rolling; and where the normal law adheres, no other adhesion does.
  using Dry = std::conditional_t<kElasticSpheres || kAdheresByItself<Normal>, NoAdhesion,
                                 std::conditional_t<kIsDryAttraction, DryAttraction, Adhesion>>;
  using SomeAdhesion = std::conditional_t<kWet, Adhesion, Dry>;
  using SomeDamping = Present<Damping, std::conditional_t<kElasticSpheres, CriticalDamping, ViscousDamping>>;
  using SomeFriction = Present<Friction, std::conditional_t<kElasticSpheres, MindlinFriction, CoulombFriction>>;
  using SomeRolling = std::conditional_t<kElasticSpheres || kWet, NoRolling, Present<Rolling, RollingSpring>>;
  using SomeTwisting =
      std::conditional_t<kElasticSpheres || kWet || Dim == 2, NoTwisting, Present<Twisting, TwistingSpring>>;

  using General = ContactLaw<Normal, SomeAdhesion, SomeDamping, SomeFriction, SomeRolling, SomeTwisting>;
  using Special =
      ContactLaw<Normal, std::conditional_t<kNoAttraction, NoAdhesion, SomeAdhesion>,
                 std::conditional_t<kNoDashpot, NoDamping, SomeDamping>, Friction, Rolling, Twisting>;
  using Type = std::conditional_t<kHasSpecialKernels<Normal>, Special, General>;
};

/// A list with one more law, unless it is there already.
template <class List, class Law>
struct With;
template <class... Laws, class Law>
struct With<std::variant<Laws...>, Law> {
  using Type =
      std::conditional_t<(std::is_same_v<Laws, Law> || ...), std::variant<Laws...>, std::variant<Laws..., Law>>;
};

/// The kernel laws of all laws for this dimension, each once.
template <int Dim, class List, class... Laws>
struct KernelLaws {
  using Type = List;
};
template <int Dim, class List, class Law, class... Rest>
struct KernelLaws<Dim, List, Law, Rest...> {
  static constexpr bool kIsForOthers = Law::kDimension != 0 && Law::kDimension != Dim;
  using Longer = typename With<List, typename KernelLawOf<Law, Dim, Partner::grain>::Type>::Type;
  using Type = typename KernelLaws<Dim, std::conditional_t<kIsForOthers, List, Longer>, Rest...>::Type;
};
template <int Dim, class Laws>
struct KernelLawsOf;
template <int Dim, class... Laws>
struct KernelLawsOf<Dim, std::variant<Laws...>> : KernelLaws<Dim, std::variant<>, Laws...> {};

}  // namespace detail

/// The kernel law of a law between grains, or between grains and walls.
template <class Law, int Dim, Partner partner = Partner::grain>
using KernelLawOf = typename detail::KernelLawOf<Law, Dim, partner>::Type;

/// The kernel laws of the law table in a dimension.
template <int Dim>
using AnyKernelLaw = typename detail::KernelLawsOf<Dim, AnyContactLaw>::Type;

/// Whether a kernel law is one of grains with walls.
template <class KernelLaw, int Dim>
inline constexpr bool kServesWalls = std::is_same_v<KernelLaw, KernelLawOf<KernelLaw, Dim, Partner::wall>>;

/// A law completed to its kernel law.
/// @pre the law is for this dimension
template <int Dim>
AnyKernelLaw<Dim> kernel_law(const AnyContactLaw& law, Partner partner);

/// Address of the alternative that a variant of laws holds: kernels are given it.
template <class AnyLaw>
const void* address_of_alternative(const AnyLaw& any_law) {
  return std::visit([](const auto& law) { return static_cast<const void*>(&law); }, any_law);
}

/// Whether grains rotate under the kernel law of a law.
bool kernel_rotates(const AnyContactLaw& law);

}  // namespace floc
