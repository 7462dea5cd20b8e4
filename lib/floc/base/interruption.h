#pragma once

#include <functional>

namespace floc {

/// Listener that long work of this thread calls now and then, as long as the listener exists, to learn whether
/// to go on.
class InterruptionListener {
 public:
  /// @param asked  function that returns if the work may go on, and otherwise throws the exception that ends it
  explicit InterruptionListener(std::function<void()> asked);
  ~InterruptionListener();
  InterruptionListener(const InterruptionListener&) = delete;
  InterruptionListener& operator=(const InterruptionListener&) = delete;

 private:
  std::function<void()> before_;
};

/// Calls the listener of this thread, if there is one, at most every 50 ms. Long work calls this function
/// between its parts, outside of parallel regions, where an exception leaves nothing half done.
/// @throws any exception of the listener
void check_interruption();

}  // namespace floc
