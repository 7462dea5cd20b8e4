#include "floc/linalg/blas.h"

#include <dlfcn.h>

#include <cstdlib>
#include <cstring>

extern "C" {
void openblas_set_num_threads(int);
char* openblas_get_corename();
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*,
            const int*, const double*, const int*, const double*, double*, const int*);
}

namespace floc {
namespace {

/// Returns the name by which OpenBLAS selects its routines with AVX-512 instructions. If this processor lacks AVX-512,
/// returns the name for AVX2 instructions; if it lacks both, null.
const char* widest_kernels() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
#endif
  return nullptr;
}

/// If OpenBLAS has not recognised the processor and uses slow routines, makes it choose its routines again. If OpenBLAS
/// was built for one type of processor only, it lacks the functions whose names begin with gotoblas_dynamic_, and
/// nothing is done.
void choose_kernels() {
  constexpr const char* kVariable = "OPENBLAS_CORETYPE";
  constexpr const char* kFallback = "Prescott";
  const auto quit = reinterpret_cast<void (*)()>(dlsym(RTLD_DEFAULT, "gotoblas_dynamic_quit"));
  const auto init = reinterpret_cast<void (*)()>(dlsym(RTLD_DEFAULT, "gotoblas_dynamic_init"));
  const char* kernels = widest_kernels();
  if (quit == nullptr || init == nullptr || kernels == nullptr) return;
  if (std::getenv(kVariable) != nullptr || std::strcmp(openblas_get_corename(), kFallback) != 0) return;
  setenv(kVariable, kernels, 1);
  quit();
  init();
  unsetenv(kVariable);
}

}  // namespace

void prepare_blas() {
  static const bool done = (openblas_set_num_threads(1), choose_kernels(), true);
  static_cast<void>(done);
}

std::string blas_library() {
  Dl_info found{};
  if (dladdr(reinterpret_cast<const void*>(&dgemm_), &found) == 0 || found.dli_fname == nullptr) return {};
  return std::string(found.dli_fname) + " (" + openblas_get_corename() + ")";
}

}  // namespace floc
