#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "floc/base/read_file.h"
#include "floc/base/sha256.h"
#include "floc/io/sealed_file.h"

namespace floc::test {

/// Returns the content of a state file with its seal appended.
inline std::string sealed(const std::string& content) {
  return content + seal_of(sha256(content));
}

/// Returns the content of a state file without its seal.
/// @pre the file is sealed
inline std::string without_seal(const std::string& bytes) {
  return bytes.substr(0, bytes.size() - kSealSize);
}

/// Writes a copy of a state file in which one text is replaced by another text of the same length, with a new seal.
/// @return path of the copy
inline std::string with_replaced(const std::string& path, const std::string& from, const std::string& to) {
  std::string content = without_seal(read_file(path));
  std::size_t n = 0;
  for (std::size_t at = content.find(from); at != std::string::npos;
       at = content.find(from, at + to.size()), ++n)
    content.replace(at, from.size(), to);
  EXPECT_EQ(n, 1u);
  const std::string other = path + ".other";
  std::ofstream(other, std::ios::binary) << sealed(content);
  return other;
}

}  // namespace floc::test
