#pragma once

#include <string>
#include <vector>

#include "floc/io/state_file.h"

namespace floc {

/// A format that can be written.
struct ExportFormat {
  std::string keyword;
  std::string description;
  std::string extension;  ///< extension of file names in this format, such as ".vtu"
  /// Writes a state to a file. On failure the file is left as it was. @throws IoError if the file cannot be written
  void (*write)(const std::string& path, const AnyState& state);
};

/// All formats that can be written. To add a format, add a writer next to the reader of the format, an entry in this
/// list, and a test that writes a file and reads it back.
const std::vector<ExportFormat>& export_formats();

/// Returns the format with this keyword or, if `keyword` is empty, the format with the extension of `path`.
/// @throws InputError listing all formats if no format matches
const ExportFormat& find_export_format(const std::string& keyword, const std::string& path);

}  // namespace floc
