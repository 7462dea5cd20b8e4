#include "floc/relaxation/kernels/kernel_law.h"

#include <cassert>

namespace floc {
namespace {

/// Converts a contact model of the scene, such as its friction, to the model type `Completed` of the kernel law. Both
/// models have the same effect.
template <class Completed, class Model>
Completed completed_model(const Model& model) {
  if constexpr (std::is_same_v<Completed, Model>)
    return model;
  else if constexpr (std::is_constructible_v<Completed, Model>)
    return Completed(model);
  else
    return kNeutral<Completed>;
}

template <class... Completed, class Law>
ContactLaw<Completed...> completed_law(std::type_identity<ContactLaw<Completed...>>, const Law& law) {
  return std::apply(
      [](const auto&... model) { return ContactLaw<Completed...>{completed_model<Completed>(model)...}; },
      std::tie(law.repulsion, law.adhesion, law.damping, law.friction, law.rolling, law.twisting));
}

}  // namespace

template <int Dim>
AnyKernelLaw<Dim> kernel_law(const AnyContactLaw& any_law, Partner partner) {
  return std::visit(
      [&]<class Law>(const Law& law) -> AnyKernelLaw<Dim> {
        if constexpr (Law::kDimension == 0 || Law::kDimension == Dim) {
          if (partner == Partner::wall)
            return completed_law(std::type_identity<KernelLawOf<Law, Dim, Partner::wall>>{}, law);
          return completed_law(std::type_identity<KernelLawOf<Law, Dim>>{}, law);
        }
        assert(!"a law for another dimension");
        return {};
      },
      any_law);
}

bool kernel_rotates(const AnyContactLaw& any_law) {
  return std::visit([]<class Law>(const Law&) { return KernelLawOf<Law, 3>::kHasFriction; }, any_law);
}

template AnyKernelLaw<2> kernel_law<2>(const AnyContactLaw&, Partner);
template AnyKernelLaw<3> kernel_law<3>(const AnyContactLaw&, Partner);

}  // namespace floc
