#pragma once

namespace floc {

/// Springs of a contact that are at their caps.
struct Mobilised {
  bool sliding = false;
  bool rolling = false;
  bool twisting = false;

  bool any() const { return sliding || rolling || twisting; }
};

}  // namespace floc
