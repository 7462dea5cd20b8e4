#pragma once

namespace floc::python {

/// Makes the dense kernels of the solvers ready (prepare_blas()), and leaves to numpy, which may use the same library,
/// the number of threads that it has.
void prepare_shared_blas();

/// While one of these lives the dense kernels run on one thread, as in the program, whose bits depend on it; after the
/// last of them on as many as before the first.
class SingleBlasThread {
 public:
  SingleBlasThread();
  ~SingleBlasThread();
  SingleBlasThread(const SingleBlasThread&) = delete;
  SingleBlasThread& operator=(const SingleBlasThread&) = delete;
};

}  // namespace floc::python
