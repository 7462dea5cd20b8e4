#pragma once

#include <string>

#include "support/scene_text.h"

namespace floc::test {

/// Scene of 40 beads of 1 to 2 mm that are compressed dry, wetted, unloaded to P = 0 and compressed again. The unit of
/// stress, f0/a^2, is 200 Pa.
inline std::string wet_scene() {
  return scene_text("wet") + R"([[load]]
to = 0
steps = 1
set = {adhesion.water_content = 0.007}
[[load]]
to = 100
steps = 1
)";
}

}  // namespace floc::test
