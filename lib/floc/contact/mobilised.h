#pragma once

namespace floc {

/// Springs of a contact whose forces have reached their caps (mobilised).
struct Mobilised {
  bool sliding = false;
  bool rolling = false;
  bool twisting = false;

  bool any() const { return sliding || rolling || twisting; }
};

}  // namespace floc
