#pragma once

#include <atomic>
#include <functional>

namespace floc {

/// Barrier at which each thread of a team waits until all threads have reached the barrier. A waiting thread spins for
/// a short time, because time steps take only tens of microseconds. After this time, it yields its core. The barriers
/// of OpenMP keep spinning, and are a thousand times slower if other programs use the same cores.
class Barrier {
 public:
  /// Exception that wait() throws if another thread will never arrive at the barrier.
  struct Abandoned {};

  explicit Barrier(int n_threads) : n_threads_(n_threads) {}

  /// Waits for the other threads. @throws Abandoned if another thread has called abandon()
  void wait() {
    if (n_threads_ > 1) wait_for_others();
  }
  /// Makes wait() throw Abandoned in the other threads. A thread that throws calls this function once, because it will
  /// not reach the barrier again.
  void abandon() { abandoned_.store(true, std::memory_order_release); }

 private:
  void wait_for_others();

  int n_threads_;
  std::atomic<int> arrived_{0};
  std::atomic<int> phase_{0};
  std::atomic<bool> abandoned_{false};
};

/// Runs `work` in several threads, numbered from 0, which synchronise at the barrier. All threads of floc are started
/// by this function. If threads throw, the other threads end at the next barrier. This function throws the exception of
/// the throwing thread with the lowest number. The exception is therefore the same in every run. (If an exception left
/// the parallel region of OpenMP, the program would end.)
/// @throws the exceptions of `work`
/// @throws InputError if OpenMP cannot start that many threads
void run_in_team(int n_threads, const std::function<void(int thread, Barrier& barrier)>& work);

}  // namespace floc
