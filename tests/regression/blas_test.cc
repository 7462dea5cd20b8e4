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

/// File a function of the running program was loaded from.
std::string origin(void (*function)()) {
  Dl_info where{};
  return dladdr(reinterpret_cast<void*>(function), &where) != 0 ? where.dli_fname : "nowhere";
}

// ATLAS, which Ceres brings along, is 2.6 times slower inside CHOLMOD. All libraries of a program share the
// first definition in the order they were linked, so these are the ones CHOLMOD and UMFPACK call.
TEST(Blas, MatrixProductsAndFactorsAreThoseOfOpenBlas) {
  EXPECT_NE(origin(&dgemm_).find("openblas"), std::string::npos) << origin(&dgemm_);
  EXPECT_NE(origin(&dpotrf_).find("openblas"), std::string::npos) << origin(&dpotrf_);
}

// An OpenBLAS older than the processor takes kernels for SSE3, five times slower.
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
