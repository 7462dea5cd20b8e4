#pragma once

namespace floc::python {

/// Calls prepare_blas(), which prepares the BLAS library for the solvers. Then restores the number of threads of the
/// library, because numpy may use the same library.
void prepare_shared_blas();

/// Restricts the BLAS library to one thread as long as an object of this class exists. The reason is that the last bits
/// of results depend on the number of threads, and the floc program uses one thread. The destructor of the last object
/// restores the number of threads that was set before the first object.
class SingleBlasThread {
 public:
  SingleBlasThread();
  ~SingleBlasThread();
  SingleBlasThread(const SingleBlasThread&) = delete;
  SingleBlasThread& operator=(const SingleBlasThread&) = delete;
};

}  // namespace floc::python
