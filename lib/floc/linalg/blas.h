#pragma once

#include <string>

namespace floc {

/// Prepares the BLAS library that the sparse solvers use. Every factorization calls this function, but only the first
/// call in a process has an effect.
/// 1. The library is limited to one thread. Sums in a fixed order then give the same bits in every run, and
///    simultaneous runs of floc do not oversubscribe the machine.
/// 2. If OpenBLAS does not know the processor, it uses SSE3 instructions, which are five times slower. In this case,
///    the widest vector instructions of the processor are selected, unless the environment variable OPENBLAS_CORETYPE
///    is set.
void prepare_blas();

/// Returns the path of the BLAS library of this process, followed by the type of processor for which the library has
/// chosen its routines; for provenance and benchmarks. Returns an empty text if the path cannot be found.
std::string blas_library();

}  // namespace floc
