#pragma once

namespace floc {

/// Which springs are at their caps.
struct Mobilised {
  bool sliding = false;
  bool rolling = false;
};

}  // namespace floc
