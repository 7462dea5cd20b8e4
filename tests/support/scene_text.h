#pragma once

#include <stdexcept>
#include <string>

#include "floc/base/read_file.h"
#include "support/places.h"

namespace floc::test {

/// A small scene up to its assembly, to which a test appends what it loads the packing by. The files also serve the
/// tests in Python (scene_texts.py).
inline std::string scene_text(const std::string& name) {
  return read_file(source_directory() + "/tests/support/scenes/" + name + ".toml");
}

/// With one part of a text, which it has to have, exchanged for another.
inline std::string exchanged(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::invalid_argument("nowhere in the text: " + old);
  return text.replace(at, old.size(), replacement);
}

}  // namespace floc::test
