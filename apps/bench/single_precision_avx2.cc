#include "single_precision_pairs.h"

namespace floc {

SingleLoop<2> single_disks_avx2() {
  return &SinglePrecisionKernel<Avx2, 2, DisksOfTrial>::compute;
}
SingleLoop<3> single_spheres_avx2() {
  return &SinglePrecisionKernel<Avx2, 3, SpheresOfTrial>::compute;
}

}  // namespace floc
