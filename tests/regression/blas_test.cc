#include <dlfcn.h>
#include <gtest/gtest.h>

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

}  // namespace
