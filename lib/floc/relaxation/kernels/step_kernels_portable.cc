#include "floc/relaxation/kernels/step_kernels_of.h"

namespace floc {

template <>
const StepKernels<2>* step_kernels_portable<2>(LatticeShape shape) {
  return step_kernel_table<Portable, 2>(shape);
}

}  // namespace floc
