#pragma once

#include <algorithm>
#include <cmath>

#include "support/laws.h"

namespace floc::test {

/// Computes the work on a contact along its normal while a test prescribes its gap: minus the integral of the static
/// normal force over the gap. The trapezoidal rule is used, which is exact for a linear force. The force may jump when
/// surfaces begin or cease to touch. A step with such a jump is divided at the gap of the jump, which is found to the
/// last bit.
template <class Law, int Dim>
class NormalWork {
 public:
  NormalWork(const Law& law, double gap) : law_(law), gap_(gap) {
    const auto response = law_.respond(at_gap<Dim>(gap), memory_).normal;
    force_ = response.force();
    touches_ = response.touches;
  }

  void move_to(double gap) {
    if (touches_at(gap) == touches_) return integrate_to(gap);
    double before = gap_, after = gap;
    for (double middle = 0.5 * (before + after); middle != before && middle != after;
         middle = 0.5 * (before + after))
      (touches_at(middle) == touches_ ? before : after) = middle;
    integrate_to(before);
    const double until_here = work_;
    integrate_to(after);
    work_ = until_here;  // the step across the jump is one rounding unit wide, so it contributes no work
    integrate_to(gap);
  }

  double work() const { return work_; }
  double largest() const { return largest_; }  ///< largest absolute value of the work so far
  bool touches() const { return touches_; }

 private:
  bool touches_at(double gap) const {
    auto memory = memory_;
    return law_.respond(at_gap<Dim>(gap), memory).normal.touches;
  }

  void integrate_to(double gap) {
    const auto response = law_.respond(at_gap<Dim>(gap), memory_).normal;
    work_ -= 0.5 * (force_ + response.force()) * (gap - gap_);
    largest_ = std::max(largest_, std::abs(work_));
    gap_ = gap;
    force_ = response.force();
    touches_ = response.touches;
  }

  Law law_;
  ContactHistoryOf<Law, Dim> memory_;
  double gap_, force_;
  bool touches_;
  double work_ = 0.0, largest_ = 0.0;
};

}  // namespace floc::test
