#include "floc/relaxation/kernels/step_kernels_of.h"

namespace floc {

const StepKernels<2>* step_kernels_avx2() {
  return StepKernelTable<Avx2, AnyContactLaw>::kTable;
}

}  // namespace floc
