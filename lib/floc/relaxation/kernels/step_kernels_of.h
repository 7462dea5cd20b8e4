#pragma once

#include <type_traits>
#include <variant>

#include "floc/relaxation/kernels/grain_kernels.h"
#include "floc/relaxation/kernels/pair_kernel.h"

namespace floc {

/// The kernels of every alternative of the law table, in its order.
template <class Isa, int Dim, LatticeShape kShape, class Laws>
struct StepKernelTable;
template <class Isa, int Dim, LatticeShape kShape, class... Law>
struct StepKernelTable<Isa, Dim, kShape, std::variant<Law...>> {
  using Grains = std::conditional_t<kShape == LatticeShape::triangular, GrainsInTriangularLattice,
                                    GrainsInRectangularLattice>;
  /// No kernels of a law for another dimension.
  template <class L>
  static constexpr StepKernels<Dim> kernels_of() {
    if constexpr (L::kDimension != 0 && L::kDimension != Dim) {
      return {};
    } else {
      // What rows hold makes no difference to the drift.
      using Drift = GrainKernels<Isa, Dim, kShape, L::kHasFriction ? RowKind::moments : RowKind::forces>;
      using Sums = GrainKernels<Isa, Dim, kShape, kRowKind<L, Dim>>;
      return {&Drift::kick_and_drift, &Drift::motion_squared, &PairKernel<Isa, Dim, Grains, L>::compute,
              &PairKernel<Isa, Dim, Walls, L>::compute, &Sums::sum_and_kick};
    }
  }
  static constexpr StepKernels<Dim> kTable[] = {kernels_of<Law>()...};
};

template <class Isa, int Dim>
const StepKernels<Dim>* step_kernel_table(LatticeShape shape) {
  return shape == LatticeShape::rectangular
             ? StepKernelTable<Isa, Dim, LatticeShape::rectangular, AnyContactLaw>::kTable
             : StepKernelTable<Isa, Dim, LatticeShape::triangular, AnyContactLaw>::kTable;
}

}  // namespace floc
