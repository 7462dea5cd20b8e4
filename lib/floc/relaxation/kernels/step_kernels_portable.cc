#include "floc/relaxation/kernels/step_kernels_of.h"

namespace floc {

const StepKernels<2>* step_kernels_portable() {
  return StepKernelTable<Portable, AnyContactLaw>::kTable;
}

}  // namespace floc
