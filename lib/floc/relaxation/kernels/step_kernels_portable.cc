#include "floc/relaxation/kernels/step_kernels_of.h"

namespace floc {

const StepKernels<2>* step_kernels_portable(LatticeShape shape) {
  return step_kernel_table<Portable>(shape);
}

}  // namespace floc
