#pragma once

#include <string>

namespace floc {

/// Prepares the dense kernels of the sparse solvers, once per process. They run in one thread: sums in a fixed
/// order give the same bits on every run, and ensembles do not oversubscribe the machine. An OpenBLAS older
/// than the processor falls back to SSE3, five times slower; it is therefore set to the widest vector kernels
/// of the processor, unless the environment variable OPENBLAS_CORETYPE names others. Every factor calls this
/// function.
void prepare_blas();

/// Returns the file of the BLAS that this process uses and the processor that its kernels are for, for
/// provenance and benchmarks; empty if it cannot be found.
std::string blas_library();

}  // namespace floc
