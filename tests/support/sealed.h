#pragma once

#include <string>

#include "floc/base/sha256.h"
#include "floc/io/sealed_file.h"

namespace floc::test {

/// The bytes of a state file with this content.
inline std::string sealed(const std::string& content) {
  return content + seal_of(sha256(content));
}

/// What a state file holds before its seal. @pre it is sealed
inline std::string without_seal(const std::string& bytes) {
  return bytes.substr(0, bytes.size() - kSealSize);
}

}  // namespace floc::test
