#pragma once

namespace floc::python {

/// Prepares the BLAS library for the solvers with prepare_blas(), and then restores its number of threads, because
/// numpy may use the same library.
void prepare_shared_blas();

/// Restricts the BLAS library to one thread as long as an object of this class exists. The last bits of results depend
/// on the number of threads, and the floc program uses one thread. The destructor of the last object restores the
/// number of threads from before the first object.
class SingleBlasThread {
 public:
  SingleBlasThread();
  ~SingleBlasThread();
  SingleBlasThread(const SingleBlasThread&) = delete;
  SingleBlasThread& operator=(const SingleBlasThread&) = delete;
};

}  // namespace floc::python
