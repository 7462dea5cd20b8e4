#include "floc/linalg/blas.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

extern "C" {
void dgemm_();
void dpotrf_();
}

namespace {

/// Returns the file from which a function of the running program was loaded.
std::string origin(void (*function)()) {
  Dl_info where{};
  return dladdr(reinterpret_cast<void*>(function), &where) != 0 ? where.dli_fname : "nowhere";
}

// Ceres also links ATLAS, which makes CHOLMOD 2.6 times slower. If several libraries define a function, the whole
// program uses the definition in the library that was linked first. This test therefore checks the functions that
// CHOLMOD and UMFPACK call.
TEST(Blas, MatrixProductsAndFactorsAreThoseOfOpenBlas) {
  EXPECT_NE(origin(&dgemm_).find("openblas"), std::string::npos) << origin(&dgemm_);
  EXPECT_NE(origin(&dpotrf_).find("openblas"), std::string::npos) << origin(&dpotrf_);
}

// An OpenBLAS that does not know the processor uses SSE3 kernels, which are five times slower.
TEST(Blas, KernelsAreNotTheFallbackWhereTheProcessorHasWiderVectors) {
  if (std::getenv("OPENBLAS_CORETYPE") != nullptr) GTEST_SKIP() << "kernels chosen by the environment";
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) GTEST_SKIP() << "no AVX2";
  floc::prepare_blas();
  EXPECT_EQ(floc::blas_library().find("Prescott"), std::string::npos) << floc::blas_library();
#else
  GTEST_SKIP() << "another family of processors";
#endif
}

}  // namespace
