#pragma once

#include <string>

#include "support/scene_text.h"

namespace floc::test {

/// Scene of adhesive grains that are compressed between walls on all sides, and then brought to twice the pressure. The
/// run takes about a second.
inline std::string box_scene(int dimension) {
  std::string text = scene_text("box");
  if (dimension == 3)
    text =
        exchanged(exchanged(text, "dimension = 2", "dimension = 3"), "sides = [1, 1.3]", "sides = [1, 1, 1.3]");
  return text + R"([[load]]
name = "load"
to = 0.2
steps = 1
[equilibrium]
stop_time = 200
[run]
seed = 3
checkpoint_every = 0.02
)";
}

}  // namespace floc::test
