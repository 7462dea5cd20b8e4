#include "floc/relaxation/kernels/step_kernels_of.h"

namespace floc {

const StepKernels<2>* step_kernels_avx2(LatticeShape shape) {
  return step_kernel_table<Avx2>(shape);
}

}  // namespace floc
