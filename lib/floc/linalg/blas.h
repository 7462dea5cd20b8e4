#pragma once

#include <string>

namespace floc {

/// Prepares the dense kernels of the sparse solvers, once per process. They run in one thread: sums in a fixed
/// order give the same bits on every run, and ensembles do not oversubscribe the machine. They are vector
/// kernels: an OpenBLAS that does not know a processor newer than itself falls back to SSE3, five times slower,
/// so it is made to take the widest kernels the processor has, unless the environment variable
/// OPENBLAS_CORETYPE names others. Every factor calls this.
void prepare_blas();

/// File of the BLAS that this process uses and the processor that its kernels are for, for provenance and
/// benchmarks; empty when it cannot be found.
std::string blas_library();

}  // namespace floc
