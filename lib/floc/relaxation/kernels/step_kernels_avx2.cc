#include "floc/relaxation/kernels/step_kernels_of.h"

namespace floc {

template <>
const StepKernels<2>* step_kernels_avx2<2>(LatticeShape shape) {
  return step_kernel_table<Avx2, 2>(shape);
}

}  // namespace floc
