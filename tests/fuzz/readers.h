#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace floc::fuzz {

/// Reader under test. Its input is the content of a whole file.
struct Reader {
  const char* name;
  /// Reads the bytes as a file. Any outcome other than a result or an InputError is a fault.
  void (*read)(const std::string& bytes);
  /// Valid inputs from which fuzzing starts.
  std::vector<std::string> (*seeds)();
};

/// Readers of the shapes of grains: .off, .obj, .stl (text and binary), .csv (in 2D and 3D) and .shp.
std::vector<Reader> shape_readers();

/// Readers of packings of MercuryDPM, LMGC90 and Rockable, of packings in VTK formats that floc does not write, and of
/// contacts with walls.
std::vector<Reader> foreign_readers();

/// All readers of files that users provide.
const std::vector<Reader>& readers();

}  // namespace floc::fuzz
