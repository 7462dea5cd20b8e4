#pragma once

namespace floc {

/// Which springs are at their caps.
struct Mobilised {
  bool sliding = false;
  bool rolling = false;
  bool twisting = false;

  bool any() const { return sliding || rolling || twisting; }
};

}  // namespace floc
