#pragma once

#include <type_traits>
#include <utility>
#include <variant>

#include "floc/base/lanes.h"
#include "floc/contact/law_table.h"
#include "floc/contact/neutral.h"
#include "floc/relaxation/partner.h"

/// Kernel laws: the contact laws for which kernels (compiled loops over pairs that compute forces) exist. A kernel
/// takes long to compile, so not every combination of contact models has its own kernel. A law without its own kernel
/// is completed to a *kernel law*, in which models without effect replace the absent models. Results are identical to
/// those of a kernel made for the law alone. KernelLawOf chooses the kernel law by these rules:
///   - All kernels have damping, except some kernels for pairs of grains (third rule). For a law without damping, the
///     damping coefficients are zero and no dashpot forces are stored.
///   - Constant adhesion, adhesion with a tail and no adhesion are represented by one model, DryAttraction.
///   - For laws without adhesion, the kernels for pairs of grains have no adhesion, because an attraction of zero would
///     take up to a tenth of the computing time of the loop over pairs. If the law also has neither friction nor
///     damping, these kernels have no damping, because dashpot forces of zero would take half of this computing time.
///   - For pairs of grains there are kernels without friction, with friction, and with friction, rolling and twisting
///     resistance.
///   - Contacts with walls are dry. Their kernels have damping and DryAttraction.
///
/// These rules apply to laws of the normal force with special kernels (kHasSpecialKernels). Every other law of the
/// normal force has only general kernels, which contain all models that can be combined with that law. General kernels
/// work for lattices of any shape. A new law of the normal force thus adds few kernels; special kernels can be added if
/// its computing time matters. If the kernel law has history variables that the contact law of the scene lacks, these
/// variables are not stored (PairKernel).
namespace floc {

/// Whether a law of the normal force has special kernels in addition to its general kernels. Special kernels leave out
/// contact models that the law of the scene lacks, or work for rectangular lattices only; both restrictions make
/// kernels faster.
template <class Normal>
inline constexpr bool kHasSpecialKernels = false;
template <>
inline constexpr bool kHasSpecialKernels<LinearRepulsion> = true;
template <>
inline constexpr bool kHasSpecialKernels<HertzRepulsion> = true;

/// Adhesion with a force that depends only on the gap, or no adhesion. In contact the force is -F0, with F0 the
/// pull-off force (zero without adhesion). An adhesion with a tail of range D0 also acts across gaps: the attraction
/// falls linearly from F0 at a gap of 0 to zero at a gap of D0.
struct DryAttraction {
  double in_contact = 0.0;  ///< pull-off force F0 (force)
  /// slope of the tail: F0/D0, with the range D0 of the tail (force/length); 0 without a tail
  double slope = 0.0;
  double at_touch = 0.0;  ///< attraction at a gap of zero: F0 with a tail, 0 without a tail (force)

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
  /// Returns zero, the stiffness of the adhesion in contact. Kernels need the stiffness only for damping, which acts
  /// only in contact.
  template <class T>
  T stiffness(const PairGeometry<T>&) const {
    return T(0);
  }
};

namespace detail {

/// Model type that is used for `Model`: `Neutral`, which has no effect, if `Model` stands for an absent model;
/// otherwise `Model` itself.
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
  // Models are combined by the rules of kIsCompiled (law_table.h): elastic spheres have no adhesion other than liquid
  // bridges; elastic spheres and grains with liquid bridges have no rolling resistance; a law of the normal force that
  // includes adhesion has no separate adhesion model.
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

/// Variant type `List` with the contact law `Law` appended as its last alternative; `List` itself if it already
/// contains `Law`.
template <class List, class Law>
struct With;
template <class... Laws, class Law>
struct With<std::variant<Laws...>, Law> {
  using Type =
      std::conditional_t<(std::is_same_v<Laws, Law> || ...), std::variant<Laws...>, std::variant<Laws..., Law>>;
};

/// Variant type `List`, extended by the kernel laws of the contact laws `Laws`. Laws that do not exist in this
/// dimension are left out, and each kernel law is listed once.
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

/// Kernel law (law with a compiled kernel) to which a contact law is completed, for pairs of grains or for pairs of a
/// grain and a wall.
template <class Law, int Dim, Partner partner = Partner::grain>
using KernelLawOf = typename detail::KernelLawOf<Law, Dim, partner>::Type;

/// Variant type of the kernel laws in 2D or in 3D. A kernel law is a contact law with a compiled kernel; there is one
/// for each alternative of AnyContactLaw.
template <int Dim>
using AnyKernelLaw = typename detail::KernelLawsOf<Dim, AnyContactLaw>::Type;

/// Whether kernels for pairs of a grain and a wall are compiled for this kernel law (contact law with a compiled
/// kernel).
template <class KernelLaw, int Dim>
inline constexpr bool kServesWalls = std::is_same_v<KernelLaw, KernelLawOf<KernelLaw, Dim, Partner::wall>>;

/// Completes a contact law to its kernel law, for which a force kernel is compiled. In the kernel law, models without
/// effect replace absent models.
/// @pre the law exists in this dimension
template <int Dim>
AnyKernelLaw<Dim> kernel_law(const AnyContactLaw& law, Partner partner);

/// Returns the address of the contact law inside a variant. Kernels receive their law by this address.
template <class AnyLaw>
const void* address_of_alternative(const AnyLaw& any_law) {
  return std::visit([](const auto& law) { return static_cast<const void*>(&law); }, any_law);
}

/// Whether the kernel law to which a contact law is completed has friction, so that grains rotate.
bool kernel_rotates(const AnyContactLaw& law);

}  // namespace floc
