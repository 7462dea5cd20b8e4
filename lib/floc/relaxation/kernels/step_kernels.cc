#include "floc/relaxation/kernels/step_kernels.h"

namespace floc {

const StepKernels<2>& step_kernels(InstructionSet set, std::size_t law_index) {
  switch (set) {
    case InstructionSet::avx512:
      return step_kernels_avx512()[law_index];
    case InstructionSet::avx2:
      return step_kernels_avx2()[law_index];
    case InstructionSet::portable:
      break;
  }
  return step_kernels_portable()[law_index];
}

}  // namespace floc
