#pragma once

#include <type_traits>
#include <variant>

#include "floc/relaxation/kernels/grain_kernels.h"
#include "floc/relaxation/kernels/pair_kernel.h"

namespace floc {

/// Table of the kernels of every kernel law (contact law for which kernels are compiled), in the order of the
/// alternatives of AnyKernelLaw.
template <class Isa, int Dim, LatticeShape kShape, class KernelLaws>
struct StepKernelTable;
template <class Isa, int Dim, LatticeShape kShape, class... Law>
struct StepKernelTable<Isa, Dim, kShape, std::variant<Law...>> {
  static constexpr bool kTriangular = kShape == LatticeShape::triangular;
  template <class L>
  static constexpr StepKernels<Dim> kernels_of() {
    // A law of the normal force without special kernels has only a kernel for triangular lattices, which is used for
    // rectangular lattices, too.
    using Grains = std::conditional_t<kTriangular || !kHasSpecialKernels<typename L::NormalModel>,
                                      GrainsInTriangularLattice, GrainsInRectangularLattice>;
    // The kernel that moves the grains depends on whether the grains rotate, but not on the layout of the moments in
    // the rows of pairs.
    using Drift = GrainKernels<Isa, Dim, kShape, L::kHasFriction ? RowKind::moments : RowKind::forces>;
    using Sums = GrainKernels<Isa, Dim, kShape, kRowKind<L, Dim>>;
    StepKernels<Dim> kernels{&Drift::kick_and_drift, &Drift::motion_squared,
                             &PairKernel<Isa, Dim, Grains, L>::compute, nullptr, &Sums::sum_and_kick};
    if constexpr (kServesWalls<L, Dim>) kernels.compute_wall_pairs = &PairKernel<Isa, Dim, Walls, L>::compute;
    return kernels;
  }
  static constexpr StepKernels<Dim> kTable[] = {kernels_of<Law>()...};
};

template <class Isa, int Dim>
const StepKernels<Dim>* step_kernel_table(LatticeShape shape) {
  return shape == LatticeShape::rectangular
             ? StepKernelTable<Isa, Dim, LatticeShape::rectangular, AnyKernelLaw<Dim>>::kTable
             : StepKernelTable<Isa, Dim, LatticeShape::triangular, AnyKernelLaw<Dim>>::kTable;
}

}  // namespace floc
