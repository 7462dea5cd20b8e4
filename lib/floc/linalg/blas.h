#pragma once

#include <string>

namespace floc {

/// Makes the dense kernels of the sparse solvers ready, once for the process. One thread: sums of a fixed order
/// give the same bits on every run, and ensembles do not oversubscribe the machine. And vector kernels: an
/// OpenBLAS that does not know a processor newer than itself falls back to SSE3, five times slower; it is made
/// to take the widest the processor has, unless the environment variable OPENBLAS_CORETYPE says which. Every
/// factor calls it.
void prepare_blas();

/// File of the BLAS that this process resolved and the processor its kernels are for, for provenance and
/// benchmarks; empty when it cannot be found.
std::string blas_library();

}  // namespace floc
