#include "floc/rigid/kernels/sweep_kernels.h"

namespace floc {

template <class Group>
const SweepKernels<Group>& sweep_kernels(InstructionSet set) {
  switch (set) {
#ifdef FLOC_HAS_AVX512
    case InstructionSet::avx512:
      return sweep_kernels_avx512<Group>();
#endif
#ifdef FLOC_HAS_AVX2
    case InstructionSet::avx2:
      return sweep_kernels_avx2<Group>();
#endif
    default:
      return sweep_kernels_portable<Group>();
  }
}

template const SweepKernels<RoundGroup<2, false>>& sweep_kernels(InstructionSet);
template const SweepKernels<RoundGroup<2, true>>& sweep_kernels(InstructionSet);
template const SweepKernels<RoundGroup<3, false>>& sweep_kernels(InstructionSet);
template const SweepKernels<RoundGroup<3, true>>& sweep_kernels(InstructionSet);
template const SweepKernels<CoupledGroup<2, false>>& sweep_kernels(InstructionSet);
template const SweepKernels<CoupledGroup<2, true>>& sweep_kernels(InstructionSet);
template const SweepKernels<CoupledGroup<3, false>>& sweep_kernels(InstructionSet);
template const SweepKernels<CoupledGroup<3, true>>& sweep_kernels(InstructionSet);

}  // namespace floc
