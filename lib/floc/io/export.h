#pragma once

#include <string>
#include <vector>

#include "floc/io/state_file.h"

namespace floc {

/// A file format in which floc can write a state.
struct ExportFormat {
  std::string keyword;
  std::string description;
  std::string extension;  ///< extension of file names in this format, such as ".vtu"
  /// Writes a state to the file `path`. If writing fails, an existing file at `path` keeps its content.
  /// @throws IoError if the file cannot be written
  void (*write)(const std::string& path, const AnyState& state);
  /// extension of the second file, if the format consists of two files in the same directory; else empty
  std::string second_extension = "";
  /// Returns the names of the data of a state that a file in this format cannot hold, such as "gravity"; null if the
  /// format holds all data that its reader takes.
  std::vector<std::string> (*lost)(const AnyState& state) = nullptr;
};

/// All file formats in which floc can write a state. To add a format, add a writer next to the reader of the format, an
/// entry in this list, and a test that writes a file and reads it back.
const std::vector<ExportFormat>& export_formats();

/// Returns the format with the keyword `keyword`. If `keyword` is empty, the extension of `path` determines the format.
/// @throws InputError listing all formats if no format matches
const ExportFormat& find_export_format(const std::string& keyword, const std::string& path);

}  // namespace floc
