#pragma once

#include "floc/rigid/kernels/coupled_model.h"
#include "floc/rigid/kernels/group_loop.h"
#include "floc/rigid/kernels/round_model.h"

namespace floc {

template <class Isa, class Group>
struct ModelOf;
template <class Isa, int Dim, bool Cell>
struct ModelOf<Isa, RoundGroup<Dim, Cell>> {
  using Type = RoundModel<Isa, Dim, Cell>;
};
template <class Isa, int Dim, bool Cell>
struct ModelOf<Isa, CoupledGroup<Dim, Cell>> {
  using Type = CoupledModel<Isa, Dim, Cell>;
};

template <class Isa, class Group>
struct SweepKernelTable {
  using Loop = GroupLoop<Isa, typename ModelOf<Isa, Group>::Type>;
  static constexpr SweepKernels<Group> kTable{&Loop::solve, &Loop::errors, &Loop::extrapolate};
};

}  // namespace floc

/// Defines the function `name` of sweep_kernels.h for all groups. The specialisations are no inline functions.
#define FLOC_SWEEP_KERNELS_OF(name, Isa, ...)            \
  template <>                                            \
  const SweepKernels<__VA_ARGS__>& name<__VA_ARGS__>() { \
    return SweepKernelTable<Isa, __VA_ARGS__>::kTable;   \
  }
#define FLOC_SWEEP_KERNELS(name, Isa)                      \
  namespace floc {                                         \
  FLOC_SWEEP_KERNELS_OF(name, Isa, RoundGroup<2, false>)   \
  FLOC_SWEEP_KERNELS_OF(name, Isa, RoundGroup<2, true>)    \
  FLOC_SWEEP_KERNELS_OF(name, Isa, RoundGroup<3, false>)   \
  FLOC_SWEEP_KERNELS_OF(name, Isa, RoundGroup<3, true>)    \
  FLOC_SWEEP_KERNELS_OF(name, Isa, CoupledGroup<2, false>) \
  FLOC_SWEEP_KERNELS_OF(name, Isa, CoupledGroup<2, true>)  \
  FLOC_SWEEP_KERNELS_OF(name, Isa, CoupledGroup<3, false>) \
  FLOC_SWEEP_KERNELS_OF(name, Isa, CoupledGroup<3, true>)  \
  }
