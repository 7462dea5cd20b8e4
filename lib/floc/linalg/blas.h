#pragma once

#include <string>

namespace floc {

/// Prepares the BLAS library that the sparse solvers use, once per process. Every factorization calls this function.
/// The library is limited to one thread: sums in a fixed order then give the same bits in every run, and simultaneous
/// runs do not oversubscribe the machine. An OpenBLAS that is older than the processor falls back to SSE3, which is
/// five times slower; it is therefore set to the widest vector instructions of the processor, unless the environment
/// variable OPENBLAS_CORETYPE is set.
void prepare_blas();

/// Returns the file of the BLAS library that this process uses, and the processor type for which its routines were
/// chosen, for provenance and benchmarks; empty if the file cannot be found.
std::string blas_library();

}  // namespace floc
