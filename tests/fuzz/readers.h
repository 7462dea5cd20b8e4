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

/// Readers of the shapes of grains: .off, .obj, .stl (text and binary), .csv (in 2D and 3D) and .shp.
std::vector<Reader> shape_readers();

/// Readers of packings of MercuryDPM, LMGC90 and Rockable, of VTK's formats but that of floc, and of contacts with walls.
std::vector<Reader> foreign_readers();

/// All readers of input that users bring.
const std::vector<Reader>& readers();

}  // namespace floc::fuzz
