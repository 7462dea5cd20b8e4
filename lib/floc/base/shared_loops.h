#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>

namespace floc {

/// Short loops whose iterations (here "turns") are shared by a team of threads. One thread of the team, the leader,
/// runs a program, and the other threads, its helpers, take part in the loops of this program. In each loop, a thread
/// first takes the turns of its own part, which is the same in every loop so that data stay in its cache, and then
/// turns from the parts of other threads. Therefore the leader never waits for a helper that has not begun a turn, for
/// example because other programs occupy its core: the leader then makes all turns alone.
class SharedLoops {
 public:
  /// Runs `program` in this thread, with n_threads - 1 helpers.
  /// @throws the exceptions of `program`
  /// @throws InputError if OpenMP cannot start that many threads
  static void run(int n_threads, const std::function<void(SharedLoops& loops)>& program);

  /// Calls work(k) once for each k from 0 to n - 1, in any order, in the threads of the team. Only the leader calls
  /// this function. Every call of `work` sees all data that the leader wrote before, and the leader sees all data that
  /// these calls wrote.
  /// @param n  at most kMostTurns
  /// @pre `work` does not throw
  void for_each(int n, const std::function<void(int)>& work);

  /// Largest number of turns of a loop.
  static constexpr int kMostTurns = (1 << 20) - 1;

 private:
  /// Turns of one part that no thread has begun yet: the number of the loop (24 bits), the first of these turns and the
  /// one after the last (20 bits each). Each part has a cache line of its own.
  struct alignas(64) Part {
    std::atomic<std::uint64_t> turns{0};
  };

  explicit SharedLoops(int n_threads);
  void help(int thread);
  /// Makes turns until no part has any left, beginning with the part of this thread.
  void take_turns(int thread);
  /// Takes one turn of a part: the first turn if the part is this thread's own, otherwise the last.
  /// @return -1 if there is none
  static int take(Part& part, bool own);

  int n_threads_;
  std::unique_ptr<Part[]> parts_;
  const std::function<void(int)>* work_ = nullptr;
  std::atomic<std::uint64_t> loop_{0};  // number of the present loop
  std::atomic<int> remaining_{0};       // turns of the present loop that have not ended
  std::atomic<bool> ended_{false};
};

}  // namespace floc
