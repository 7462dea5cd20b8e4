#include "single_precision_pairs.h"

namespace floc {

SingleLoop<2> single_disks_avx512() {
  return &SinglePrecisionKernel<Avx512, 2, DisksOfTrial>::compute;
}
SingleLoop<3> single_spheres_avx512() {
  return &SinglePrecisionKernel<Avx512, 3, SpheresOfTrial>::compute;
}

}  // namespace floc
