#include "floc/relaxation/kernels/step_kernels_of.h"

namespace floc {

template <>
const StepKernels<3>* step_kernels_avx2<3>(LatticeShape shape) {
  return step_kernel_table<Avx2, 3>(shape);
}

}  // namespace floc
