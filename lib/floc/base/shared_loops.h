#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>

namespace floc {

/// Short loops whose iterations, here called "turns", are shared by a team of threads. One thread of the team, the
/// leader, runs a program. The other threads, the helpers, take part in the loops of this program. A loop is divided
/// into one part for each thread. A thread first runs the turns of its own part, and then turns from the parts of other
/// threads. In all loops of equal length, a thread has the same part, so that data stay in the cache of the thread. The
/// leader waits only for turns that a helper has begun: if other programs occupy the cores of all helpers, the leader
/// runs all turns alone.
class SharedLoops {
 public:
  /// Runs `program` in this thread, with n_threads - 1 helpers.
  /// @throws the exceptions of `program`
  /// @throws InputError if OpenMP cannot start that many threads
  static void run(int n_threads, const std::function<void(SharedLoops& loops)>& program);

  /// Calls work(k) once for each k from 0 to n - 1, in any order, in the threads of the team. Only the leader calls
  /// this function. Every call of `work` sees all data that the leader wrote before the loop. After the loop, the
  /// leader sees all data that the calls wrote.
  /// @param n  at most kMostTurns
  /// @pre `work` does not throw
  void for_each(int n, const std::function<void(int)>& work);

  /// Largest number of turns of a loop.
  static constexpr int kMostTurns = (1 << 20) - 1;

 private:
  /// The turns of one part that no thread has begun yet. The 64 bits of `turns` contain the number of the loop (24
  /// bits), the index of the first turn (20 bits), and the index after the last turn (20 bits). Each part has a cache
  /// line of its own.
  struct alignas(64) Part {
    std::atomic<std::uint64_t> turns{0};
  };

  explicit SharedLoops(int n_threads);
  void help(int thread);
  /// Runs turns of the part of this thread and then of the other parts, until all parts are empty.
  void take_turns(int thread);
  /// Takes one turn of a part: the first turn if the part belongs to this thread, otherwise the last turn.
  /// @return number of the turn; -1 if the part has no turns left
  static int take(Part& part, bool own);

  int n_threads_;
  std::unique_ptr<Part[]> parts_;
  const std::function<void(int)>* work_ = nullptr;
  std::atomic<std::uint64_t> loop_{0};  // number of the present loop
  std::atomic<int> remaining_{0};       // turns of the present loop that have not ended
  std::atomic<bool> ended_{false};
};

}  // namespace floc
