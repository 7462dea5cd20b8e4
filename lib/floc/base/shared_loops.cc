#include "floc/base/shared_loops.h"

#include <cassert>
#include <thread>

#include "floc/base/thread_team.h"

namespace floc {
namespace {

constexpr int kBits = 20;  // number of bits that store the index of a turn

/// Number of times that a waiting thread tests its condition before it yields its core.
constexpr int kSpins = 2000;

template <class Condition>
void wait_until(const Condition& condition) {
  for (int spin = 0; !condition(); ++spin)
    if (spin > kSpins) std::this_thread::yield();
}

}  // namespace

SharedLoops::SharedLoops(int n_threads)
    : n_threads_(n_threads), parts_(std::make_unique<Part[]>(static_cast<std::size_t>(n_threads))) {}

void SharedLoops::run(int n_threads, const std::function<void(SharedLoops& loops)>& program) {
  SharedLoops loops(n_threads);
  run_in_team(n_threads, [&](int thread, Barrier&) {
    if (thread != 0) return loops.help(thread);
    // The helper threads end when `program` ends, even if it throws.
    struct End {
      std::atomic<bool>& ended;
      ~End() { ended.store(true, std::memory_order_release); }
    } end{loops.ended_};
    program(loops);
  });
}

void SharedLoops::for_each(int n, const std::function<void(int)>& work) {
  assert(n <= kMostTurns);
  if (n_threads_ == 1 || n <= 1) {
    for (int k = 0; k < n; ++k) work(k);
    return;
  }
  // All turns of the previous loop have ended. No thread can therefore take a turn before the parts are stored below.
  work_ = &work;
  remaining_.store(n, std::memory_order_relaxed);
  const std::uint64_t loop = loop_.load(std::memory_order_relaxed) + 1;
  for (int t = 0; t < n_threads_; ++t) {
    const auto first = static_cast<std::uint64_t>(std::int64_t{n} * t / n_threads_);
    const auto end = static_cast<std::uint64_t>(std::int64_t{n} * (t + 1) / n_threads_);
    parts_[t].turns.store(loop << 2 * kBits | first << kBits | end, std::memory_order_release);
  }
  loop_.store(loop, std::memory_order_release);
  take_turns(0);
  wait_until([&] { return remaining_.load(std::memory_order_acquire) == 0; });
}

void SharedLoops::help(int thread) {
  std::uint64_t seen = 0;
  while (true) {
    wait_until([&] {
      return loop_.load(std::memory_order_acquire) != seen || ended_.load(std::memory_order_acquire);
    });
    if (ended_.load(std::memory_order_acquire)) return;
    seen = loop_.load(std::memory_order_acquire);
    take_turns(thread);
  }
}

void SharedLoops::take_turns(int thread) {
  for (int n = 0; n < n_threads_; ++n) {
    Part& part = parts_[(thread + n) % n_threads_];
    // While a thread runs a turn, the loop cannot end, and `work_` cannot change.
    for (int k = take(part, n == 0); k >= 0; k = take(part, n == 0)) {
      (*work_)(k);
      remaining_.fetch_sub(1, std::memory_order_acq_rel);
    }
  }
}

int SharedLoops::take(Part& part, bool own) {
  constexpr std::uint64_t kTurn = (std::uint64_t{1} << kBits) - 1;
  std::uint64_t turns = part.turns.load(std::memory_order_acquire);
  while (true) {
    const std::uint64_t first = turns >> kBits & kTurn, end = turns & kTurn;
    if (first == end) return -1;
    const std::uint64_t rest = own ? turns + (kTurn + 1) : turns - 1;
    if (part.turns.compare_exchange_weak(turns, rest, std::memory_order_acq_rel, std::memory_order_acquire))
      return static_cast<int>(own ? first : end - 1);
  }
}

}  // namespace floc
