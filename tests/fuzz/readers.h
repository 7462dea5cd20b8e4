#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace floc::fuzz {

/// One reader under test: what it is fed is a whole file's content.
struct Reader {
  const char* name;
  /// Reads the bytes as a file; anything but a result or an InputError is a fault.
  void (*read)(const std::string& bytes);
  /// Valid inputs to start from.
  std::vector<std::string> (*seeds)();
};

/// All readers of input that users bring.
const std::vector<Reader>& readers();

}  // namespace floc::fuzz
