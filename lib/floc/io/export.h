#pragma once

#include <string>
#include <vector>

#include "floc/io/state_file.h"

namespace floc {

/// A format that can be written.
struct ExportFormat {
  std::string keyword;
  std::string description;
  std::string extension;  ///< of the names of its files, ".vtu"
  /// Writes a whole file or, on failure, none: @throws IoError.
  void (*write)(const std::string& path, const AnyState& state);
};

/// THE list of formats. To add one: a writer beside its reader, a row here, a test that reads back what it
/// wrote.
const std::vector<ExportFormat>& export_formats();

/// The format of `keyword`, or, if that is empty, the one of the file's extension.
/// @throws InputError listing the formats if there is none.
const ExportFormat& find_export_format(const std::string& keyword, const std::string& path);

}  // namespace floc
