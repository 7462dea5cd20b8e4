#include "floc/relaxation/kernels/step_kernels_of.h"

namespace floc {

template <>
const StepKernels<3>* step_kernels_portable<3>(LatticeShape shape) {
  return step_kernel_table<Portable, 3>(shape);
}

}  // namespace floc
