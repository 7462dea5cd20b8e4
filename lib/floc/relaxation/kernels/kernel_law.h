#pragma once

#include <type_traits>
#include <utility>
#include <variant>

#include "floc/base/lanes.h"
#include "floc/contact/law_table.h"
#include "floc/contact/neutral.h"
#include "floc/relaxation/partner.h"

/// Kernel laws: the laws for which pair kernels are compiled. A kernel takes long to compile, so not every
/// composition of the law table has one. A law is completed to a *kernel law* by neutral models, whose kernel
/// gives results identical to those of a kernel of its own. KernelLawOf decides:
///   - Kernels have damping. A law without it has coefficients of zero, and its dashpot forces are not kept.
///   - Constant adhesion and adhesion with a tail are one model, DryAttraction, which also represents no
/// adhesion.
///   - Pairs of grains without adhesion have kernels without adhesion, since an attraction of zero would take
/// up to a tenth of the pass; if they have no friction either, they have kernels without damping, since a
/// dashpot would take half of it.
///   - Grains have kernels without friction, with it, and with rolling and twisting.
///   - Walls are dry, and their kernels have damping and DryAttraction.
/// This applies to normal laws with special kernels (kHasSpecialKernels). Other normal laws have only general
/// kernels, which hold all models that can be combined with the normal law and are for lattices of any shape. A
/// new normal law thus adds few kernels; give it special ones where its speed matters. History that only the
/// kernel law has, and not the law of the scene, is not stored (PairKernel).
namespace floc {

/// Whether a normal law has special kernels, which are faster: for laws without some models, and for
/// rectangular lattices.
template <class Normal>
inline constexpr bool kHasSpecialKernels = false;
template <>
inline constexpr bool kHasSpecialKernels<LinearRepulsion> = true;
template <>
inline constexpr bool kHasSpecialKernels<HertzRepulsion> = true;

/// Adhesion that depends on the gap alone, or none: -F0 in contact and, with a tail, linearly falling to zero
/// across a gap.
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
  /// Zero in contact, which is all that matters: kernels read the stiffness only for damping in contact.
  template <class T>
  T stiffness(const PairGeometry<T>&) const {
    return T(0);
  }
};

namespace detail {

/// Model, or Neutral where Model is absent.
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
  // Models are combined as in kIsCompiled: elastic spheres adhere only by liquid; neither they nor grains with
  // liquid resist rolling; and a normal law that includes adhesion has no other adhesion.
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

/// List with one more law, unless the list holds it already.
template <class List, class Law>
struct With;
template <class... Laws, class Law>
struct With<std::variant<Laws...>, Law> {
  using Type =
      std::conditional_t<(std::is_same_v<Laws, Law> || ...), std::variant<Laws...>, std::variant<Laws..., Law>>;
};

/// Kernel laws of all laws for this dimension, each once.
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

/// Kernel law of a law between grains, or between grains and walls.
template <class Law, int Dim, Partner partner = Partner::grain>
using KernelLawOf = typename detail::KernelLawOf<Law, Dim, partner>::Type;

/// Variant of the kernel laws of the law table in a dimension.
template <int Dim>
using AnyKernelLaw = typename detail::KernelLawsOf<Dim, AnyContactLaw>::Type;

/// Whether a kernel law has kernels for pairs of grains with walls.
template <class KernelLaw, int Dim>
inline constexpr bool kServesWalls = std::is_same_v<KernelLaw, KernelLawOf<KernelLaw, Dim, Partner::wall>>;

/// Completes a law to its kernel law.
/// @pre the law is for this dimension
template <int Dim>
AnyKernelLaw<Dim> kernel_law(const AnyContactLaw& law, Partner partner);

/// Address of the alternative that a variant of laws holds, as passed to kernels.
template <class AnyLaw>
const void* address_of_alternative(const AnyLaw& any_law) {
  return std::visit([](const auto& law) { return static_cast<const void*>(&law); }, any_law);
}

/// Whether grains rotate under the kernel law of a law.
bool kernel_rotates(const AnyContactLaw& law);

}  // namespace floc
