#include "floc/relaxation/kernels/step_kernels_of.h"

namespace floc {

const StepKernels<2>* step_kernels_avx512(LatticeShape shape) {
  return step_kernel_table<Avx512>(shape);
}

}  // namespace floc
