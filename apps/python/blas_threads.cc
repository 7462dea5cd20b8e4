#include "blas_threads.h"

#include <mutex>

#include "floc/linalg/blas.h"

extern "C" {
int openblas_get_num_threads();
void openblas_set_num_threads(int);
}

namespace floc::python {
namespace {

std::mutex g_mutex;
int g_alive = 0;
int g_threads_before = 0;

}  // namespace

void prepare_shared_blas() {
  const SingleBlasThread single;
  prepare_blas();
}

SingleBlasThread::SingleBlasThread() {
  const std::lock_guard lock(g_mutex);
  if (g_alive++ > 0) return;
  g_threads_before = openblas_get_num_threads();
  openblas_set_num_threads(1);
}

SingleBlasThread::~SingleBlasThread() {
  const std::lock_guard lock(g_mutex);
  if (--g_alive == 0) openblas_set_num_threads(g_threads_before);
}

}  // namespace floc::python
