#pragma once

#include <string>

namespace floc {

/// Prepares the BLAS library that the sparse solvers use, once per process. Every factorization calls this function.
/// 1. The library is limited to one thread. Sums in a fixed order then give the same bits in every run, and
///    simultaneous runs of floc do not oversubscribe the machine.
/// 2. An OpenBLAS that is older than the processor would use SSE3, which is five times slower. It is made to use the
///    widest vector instructions of the processor, unless the environment variable OPENBLAS_CORETYPE is set.
void prepare_blas();

/// Returns the path of the BLAS library that this process uses, followed by the processor type for which the library
/// has chosen its routines, for provenance and benchmarks; empty if the path cannot be found.
std::string blas_library();

}  // namespace floc
