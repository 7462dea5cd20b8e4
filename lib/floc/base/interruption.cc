#include "floc/base/interruption.h"

#include <chrono>
#include <utility>

namespace floc {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenQuestions{50};

thread_local std::function<void()> t_asked;
thread_local Clock::time_point t_last;

}  // namespace

InterruptionListener::InterruptionListener(std::function<void()> asked) : before_(std::move(t_asked)) {
  t_asked = std::move(asked);
  t_last = Clock::now();
}

InterruptionListener::~InterruptionListener() {
  t_asked = std::move(before_);
}

void check_interruption() {
  if (!t_asked) return;
  const auto now = Clock::now();
  if (now - t_last < kBetweenQuestions) return;
  t_last = now;
  t_asked();
}

}  // namespace floc
