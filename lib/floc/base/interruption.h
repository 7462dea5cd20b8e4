#pragma once

#include <functional>

namespace floc {

/// Registers a function that the long computations of this thread call now and then, to learn whether they should go
/// on. The function stays registered as long as this object exists.
class InterruptionListener {
 public:
  /// @param asked  function that returns if the computation may go on, and otherwise throws the exception that ends it
  explicit InterruptionListener(std::function<void()> asked);
  ~InterruptionListener();
  InterruptionListener(const InterruptionListener&) = delete;
  InterruptionListener& operator=(const InterruptionListener&) = delete;

 private:
  std::function<void()> before_;
};

/// Calls the function of the InterruptionListener of this thread, if there is one, but not more often than every 50 ms.
/// Long computations call check_interruption() between two stages of their work and outside of parallel regions, where
/// an exception leaves no data half changed.
/// @throws any exception of the listener's function
void check_interruption();

}  // namespace floc
