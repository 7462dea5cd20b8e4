#pragma once

namespace floc {

/// Which springs of a contact (tangential, rolling, twisting) are mobilised, that is, have a force or moment that has
/// reached its cap.
struct Mobilised {
  bool sliding = false;
  bool rolling = false;
  bool twisting = false;

  bool any() const { return sliding || rolling || twisting; }
};

}  // namespace floc
