#pragma once

#include <string>

namespace floc {

/// Holds the dense kernels of the sparse solvers to one thread, once for the process: sums of a fixed order
/// give the same bits on every run, and ensembles do not oversubscribe the machine. Every factor calls it.
void use_one_blas_thread();

/// File of the BLAS that this process resolved, for provenance and benchmarks; empty when it cannot be told.
std::string blas_library();

}  // namespace floc
