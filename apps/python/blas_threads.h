#pragma once

namespace floc::python {

/// Prepares the dense kernels of the solvers (prepare_blas()), and restores their number of threads, because numpy
/// may use the same library.
void prepare_shared_blas();

/// Restricts the dense kernels to one thread as long as an object of this class exists, as in the program, because
/// the last bits of results depend on it. When the last object is destroyed, the number of threads is again that
/// before the first one.
class SingleBlasThread {
 public:
  SingleBlasThread();
  ~SingleBlasThread();
  SingleBlasThread(const SingleBlasThread&) = delete;
  SingleBlasThread& operator=(const SingleBlasThread&) = delete;
};

}  // namespace floc::python
