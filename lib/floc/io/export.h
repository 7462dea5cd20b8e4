#pragma once

#include <string>
#include <vector>

#include "floc/io/state_file.h"

namespace floc {

/// A format that can be written.
struct ExportFormat {
  std::string keyword;
  std::string description;
  std::string extension;  ///< extension of its file names, such as ".vtu"
  /// Writes the whole file or, on failure, none. @throws IoError if it cannot be written
  void (*write)(const std::string& path, const AnyState& state);
};

/// All formats that can be written. To add one: a writer beside its reader, a row in this list, and a test that reads
/// back what the writer wrote.
const std::vector<ExportFormat>& export_formats();

/// Returns the format with this keyword or, if `keyword` is empty, the format with the extension of `path`.
/// @throws InputError listing the formats if there is none
const ExportFormat& find_export_format(const std::string& keyword, const std::string& path);

}  // namespace floc
