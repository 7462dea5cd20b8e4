#include "floc/relaxation/kernels/step_kernels_of.h"

namespace floc {

const StepKernels<2>* step_kernels_avx512() {
  return StepKernelTable<Avx512, AnyContactLaw>::kTable;
}

}  // namespace floc
