#include "floc/base/thread_team.h"

#include <fmt/format.h>
#include <omp.h>

#include <exception>
#include <thread>
#include <vector>

#include "floc/base/error.h"

namespace floc {
namespace {

/// Number of times that a waiting thread checks the barrier before it yields its core.
constexpr int kSpins = 2000;

void require_team(int n_threads) {
  if (const int n = omp_get_num_threads(); n != n_threads)
    throw InputError(
        "threads",
        fmt::format(
            "{} threads were requested, but OpenMP starts only {}: change OMP_THREAD_LIMIT or OMP_DYNAMIC "
            "so that OpenMP can start all of them, or request fewer threads",
            n_threads, n));
}

}  // namespace

void Barrier::wait_for_others() {
  const int phase = phase_.load(std::memory_order_acquire);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == n_threads_) {
    arrived_.store(0, std::memory_order_relaxed);
    phase_.store(phase + 1, std::memory_order_release);
    return;
  }
  for (int spin = 0; phase_.load(std::memory_order_acquire) == phase; ++spin) {
    // The second test is needed because this barrier may already be open when another thread calls abandon(). In this
    // case, this wait() returns, and the next wait() throws.
    if (abandoned_.load(std::memory_order_acquire) && phase_.load(std::memory_order_acquire) == phase)
      throw Abandoned();
    if (spin > kSpins) std::this_thread::yield();
  }
}

void run_in_team(int n_threads, const std::function<void(int thread, Barrier& barrier)>& work) {
  Barrier barrier(n_threads);
  std::vector<std::exception_ptr> thrown(static_cast<std::size_t>(n_threads));
#pragma omp parallel num_threads(n_threads) if (n_threads > 1)
  {
    const int thread = omp_get_thread_num();
    try {
      require_team(n_threads);
      work(thread, barrier);
    } catch (const Barrier::Abandoned&) {
      // Abandoned is not recorded: run_in_team() throws the exception of the thread that called abandon().
    } catch (...) {
      thrown[static_cast<std::size_t>(thread)] = std::current_exception();
      barrier.abandon();
    }
  }
  for (const std::exception_ptr& exception : thrown)
    if (exception) std::rethrow_exception(exception);
}

}  // namespace floc
