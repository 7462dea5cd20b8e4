#pragma once

#include <functional>

namespace floc {

/// Registers a function that long computations in this thread call repeatedly, so that the function can end them. The
/// function stays registered as long as this object exists.
class InterruptionListener {
 public:
  /// @param asked  function that returns normally if the computation may continue, and otherwise throws the exception
  /// that ends the computation
  explicit InterruptionListener(std::function<void()> asked);
  ~InterruptionListener();
  InterruptionListener(const InterruptionListener&) = delete;
  InterruptionListener& operator=(const InterruptionListener&) = delete;

 private:
  std::function<void()> before_;
};

/// Calls the function that this thread has registered by an InterruptionListener, if any, but at most once in 50 ms.
/// Long computations call check_interruption() between two stages of their work and outside of parallel regions, where
/// an exception leaves no data half changed.
/// @throws any exception of the registered function
void check_interruption();

}  // namespace floc
