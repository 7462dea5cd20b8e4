#pragma once

#include <stdexcept>
#include <string>

#include "floc/base/read_file.h"
#include "support/places.h"

namespace floc::test {

/// Returns the text of a small scene up to its assembly. Tests append load stages to this text. Tests in Python read
/// the text from the same files (scene_texts.py).
inline std::string scene_text(const std::string& name) {
  return read_file(source_directory() + "/tests/support/scenes/" + name + ".toml");
}

/// Returns the text with one part replaced.
/// @pre the text contains `old`
inline std::string exchanged(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::invalid_argument("nowhere in the text: " + old);
  return text.replace(at, old.size(), replacement);
}

}  // namespace floc::test
