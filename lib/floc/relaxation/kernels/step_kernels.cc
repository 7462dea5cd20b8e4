#include "floc/relaxation/kernels/step_kernels.h"

namespace floc {

const StepKernels<2>& step_kernels(InstructionSet set, LatticeShape shape, std::size_t law_index) {
  switch (set) {
    case InstructionSet::avx512:
      return step_kernels_avx512(shape)[law_index];
    case InstructionSet::avx2:
      return step_kernels_avx2(shape)[law_index];
    case InstructionSet::portable:
      break;
  }
  return step_kernels_portable(shape)[law_index];
}

}  // namespace floc
