#include "floc/linalg/blas.h"

#include <dlfcn.h>

extern "C" {
void openblas_set_num_threads(int);
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*,
            const int*, const double*, const int*, const double*, double*, const int*);
}

namespace floc {

void use_one_blas_thread() {
  static const bool done = (openblas_set_num_threads(1), true);
  static_cast<void>(done);
}

std::string blas_library() {
  Dl_info found{};
  if (dladdr(reinterpret_cast<const void*>(&dgemm_), &found) == 0 || found.dli_fname == nullptr) return {};
  return found.dli_fname;
}

}  // namespace floc
