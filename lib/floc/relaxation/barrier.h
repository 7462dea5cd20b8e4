#pragma once

#include <atomic>
#include <thread>

namespace floc {

/// A point that all threads of a team reach before any goes on. Waiting threads spin for a moment, since time
/// steps are tens of microseconds, then give their core away: OpenMP's own barriers keep spinning, and are a
/// thousand times slower when other programs share the cores.
class Barrier {
 public:
  explicit Barrier(int n_threads) : n_threads_(n_threads) {}

  void wait() {
    if (n_threads_ == 1) return;
    const int phase = phase_.load(std::memory_order_acquire);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == n_threads_) {
      arrived_.store(0, std::memory_order_relaxed);
      phase_.store(phase + 1, std::memory_order_release);
      return;
    }
    for (int spin = 0; phase_.load(std::memory_order_acquire) == phase; ++spin)
      if (spin > kSpins) std::this_thread::yield();
  }

 private:
  static constexpr int kSpins = 2000;

  int n_threads_;
  std::atomic<int> arrived_{0};
  std::atomic<int> phase_{0};
};

}  // namespace floc
