#include "floc/relaxation/kernels/step_kernels_of.h"

namespace floc {

template <>
const StepKernels<2>* step_kernels_avx512<2>(LatticeShape shape) {
  return step_kernel_table<Avx512, 2>(shape);
}

}  // namespace floc
