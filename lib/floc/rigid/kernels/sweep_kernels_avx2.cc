#include "floc/rigid/kernels/sweep_kernels_of.h"

FLOC_SWEEP_KERNELS(sweep_kernels_avx2, Avx2)
