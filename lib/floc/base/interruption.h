#pragma once

#include <functional>

namespace floc {

/// While it lives, long work of this thread asks now and then whether to go on.
class InterruptionListener {
 public:
  /// @param asked  returns if the work may go on, and throws what is to end it otherwise
  explicit InterruptionListener(std::function<void()> asked);
  ~InterruptionListener();
  InterruptionListener(const InterruptionListener&) = delete;
  InterruptionListener& operator=(const InterruptionListener&) = delete;

 private:
  std::function<void()> before_;
};

/// Asks the listener of this thread, if there is one, at most every 50 ms. It is called between parts of long work,
/// outside of parallel regions, where an exception leaves nothing half done.
/// @throws what the listener throws
void check_interruption();

}  // namespace floc
