#include "floc/relaxation/kernels/step_kernels.h"

namespace floc {

template <int Dim>
const StepKernels<Dim>& step_kernels(InstructionSet set, LatticeShape shape, std::size_t law_index) {
  switch (set) {
#ifdef FLOC_HAS_AVX512
    case InstructionSet::avx512:
      return step_kernels_avx512<Dim>(shape)[law_index];
#endif
#ifdef FLOC_HAS_AVX2
    case InstructionSet::avx2:
      return step_kernels_avx2<Dim>(shape)[law_index];
#endif
    default:
      return step_kernels_portable<Dim>(shape)[law_index];
  }
}

template const StepKernels<2>& step_kernels<2>(InstructionSet, LatticeShape, std::size_t);
template const StepKernels<3>& step_kernels<3>(InstructionSet, LatticeShape, std::size_t);

}  // namespace floc
