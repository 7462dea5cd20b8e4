#pragma once

#include <atomic>
#include <functional>

namespace floc {

/// A point that all threads of a team reach before any goes on. Waiting threads spin for a moment, since time
/// steps are tens of microseconds, then give their core away: OpenMP's own barriers keep spinning, and are a
/// thousand times slower when other programs share the cores.
class Barrier {
 public:
  /// What wait() throws where another thread never comes.
  struct Abandoned {};

  explicit Barrier(int n_threads) : n_threads_(n_threads) {}

  /// @throws Abandoned if another thread has given up on its way here
  void wait() {
    if (n_threads_ > 1) wait_for_others();
  }
  /// Called once by a thread that is not going to wait again: the others cannot meet it any more.
  void abandon() { abandoned_.store(true, std::memory_order_release); }

 private:
  void wait_for_others();

  int n_threads_;
  std::atomic<int> arrived_{0};
  std::atomic<int> phase_{0};
  std::atomic<bool> abandoned_{false};
};

/// Does `work` in each of several threads, which are numbered from 0 and meet at the barrier: the only way in which
/// floc starts threads. An exception may not leave a parallel region of OpenMP, which would end the program: where
/// threads throw, the others end at the barrier that they reach next, and one exception leaves this function.
/// Between two barriers every thread comes to its end or throws, so it is the same one each time: that of the
/// first of the threads that threw.
///
/// @throws what `work` throws
/// @throws InputError if OpenMP is kept from starting that many threads
void run_in_team(int n_threads, const std::function<void(int thread, Barrier& barrier)>& work);

}  // namespace floc
