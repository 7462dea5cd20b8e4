#pragma once

#include "floc/scene/read_scene.h"
#include "support/kill_and_resume.h"

namespace floc::test {

/// The small scene with 20 disks and one step per decade. It has two states of assembly (at zero pressure and
/// at the first pressure), two equilibria of loading and one of unloading.
inline Scene twenty_disks() {
  return parse_scene(small_scene(), "small.toml", ".", {"grains.count=20", "load.0.steps_per_decade=1"});
}

}  // namespace floc::test
